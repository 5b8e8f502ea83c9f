//! The command `export`, read back by an independent reader of OBJ.

use shadetrade::scene;
use tobj::{GPU_LOAD_OPTIONS, LoadOptions};

use super::{SCENE, assert_failed, assert_works, cube, folder, get, listing, put, run, shadetrade};
use crate::support::prelude::*;

type Parts<'a> = (&'a Transform, &'a Mesh, &'a NormalMode, &'a Material);

/// The default scene, with a second cuboid that is turned and has face normals.
fn two() -> String {
    let mut record = built_in_record();
    let mut other = records::cuboid("a second, sharp", [1.0, 2.0, 0.3], [0.1, 5.0, 0.7]);
    (other.rotation, other.normals) = (DVec3::new(10.0, 20.0, 30.0), NormalMode::Face);
    record.cuboid.push(other);
    scene::updated("", &record)
}

fn three(numbers: &[f64], index: u32) -> DVec3 {
    DVec3::from_slice(&numbers[3 * index as usize..])
}

#[test]
fn an_exported_scene_is_read_back_with_the_grid_of_each_face() {
    let folder = folder();
    put(folder.path(), "two.toml", two());
    let scene = Scene::load_path(&folder.path().join("two.toml")).expect("a scene");
    let file = folder.path().join("two.obj");
    // The corners of a cuboid, or the points of six grids; and the triangles.
    for (segments, points, triangles) in [(1.0, 8, 12), (3.0, 6 * 16, 6 * 18)] {
        let line = format!("export two.toml --segments {segments} -o two.obj");
        assert_works(folder.path(), &line);
        let (models, materials) = tobj::load_obj(&file, &LoadOptions::default()).expect("OBJ");
        let materials = materials.expect("a material library");
        assert_eq!([models.len(), materials.len()], [2, 2]);
        assert_eq!(models[1].name, "a_second__sharp");
        // An engine that knows one index a vertex reads the same.
        assert!(tobj::load_obj(&file, &GPU_LOAD_OPTIONS).is_ok());
        let cuboids = in_file_order::<Parts, _>(&scene.world, |(at, mesh, mode, material)| {
            (*at, *mesh, *mode, *material)
        });
        for ((model, library), (at, mesh, mode, material)) in
            models.iter().zip(&materials).zip(cuboids)
        {
            let read = &model.mesh;
            let lengths = [read.positions.len(), read.indices.len()];
            assert_eq!(lengths, [3 * points, 3 * triangles]);
            let corners = mesh.corners.map(|corner| at.position + at.axes() * corner);
            let own = |world: DVec3| at.axes().transpose() * world;
            let mut area = 0.0;
            for (points, normals) in read.indices.chunks(3).zip(read.normal_indices.chunks(3)) {
                let points = [0, 1, 2].map(|it| three(&read.positions, points[it]));
                let [a, b, c] = points.map(|point| own(point - at.position));
                let across = (b - a).cross(c - a);
                area += across.length() / 2.0;
                // A face, and its triangles are counter-clockwise seen from outside.
                let axis = (0..3).find(|axis| across[*axis].abs() > 1e-9);
                let axis = axis.expect("an area");
                for (point, index) in points.into_iter().zip(normals) {
                    assert!(segments > 1.0 || corners.contains(&point), "bit for bit");
                    let share = own(point - at.position) / mesh.corners[7];
                    assert!((share[axis] - across[axis].signum()).abs() < 1e-12);
                    let steps = (share + 1.0) / 2.0 * segments;
                    assert!(
                        (steps - steps.round()).abs().max_element() < 1e-9,
                        "{steps}"
                    );
                    let expected = match mode {
                        NormalMode::Corner => share.normalize(),
                        NormalMode::Face => across.normalize(),
                    };
                    assert!((own(three(&read.normals, *index)) - expected).length() < 1e-12);
                }
            }
            let size = mesh.size();
            let whole = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
            assert!((area - whole).abs() < 1e-9, "{area} of {whole}");
            let coefficients = [library.ambient, library.diffuse, library.specular];
            let expected = [material.ambient, material.diffuse, material.specular];
            assert_eq!(coefficients, expected.map(|it| Some(it.to_array())));
            assert_eq!(library.shininess, Some(material.shininess));
        }
    }
}

#[test]
fn each_object_has_a_name_of_its_own_and_the_library_one_without_blanks() {
    let folder = folder();
    let cubes = ["a b", "a_b_2", "a,b"].map(|name| cube(name, [0.0; 3]));
    let camera = "[[camera]]\nname = \"1\"\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\nfov = 30\nheight = 6\n";
    put(folder.path(), "three.toml", cubes.concat() + camera);
    let file = folder.path().join("my boxes.obj");
    let output = shadetrade(folder.path())
        .args(["export", "three.toml", "-o", "my boxes.obj"])
        .output();
    assert!(output.expect("the program starts").status.success());
    let (models, materials) = tobj::load_obj(&file, &LoadOptions::default()).expect("an OBJ file");
    let names: Vec<&str> = models.iter().map(|model| &*model.name).collect();
    assert_eq!(names, ["a_b", "a_b_2", "a_b_3"]);
    let materials = materials.expect("a material library").into_iter();
    assert_eq!(materials.map(|it| it.name).collect::<Vec<_>>(), names);
    let files = listing(folder.path());
    assert_eq!(files, ["my boxes.obj", "my_boxes.mtl", "three.toml"]);
}

#[test]
fn a_library_that_another_file_names_is_not_replaced() {
    let folder = folder();
    let folder = folder.path();
    for _ in 0..2 {
        assert_works(folder, "export -o a_b.obj");
    }
    let library = get(folder, "a_b.mtl");
    put(folder, "scene.toml", SCENE);
    let line = "export scene.toml --shading phong -o a+b.obj";
    assert_failed(&run(folder, line), 1, "a_b.mtl|a_b.obj");
    assert_eq!(get(folder, "a_b.mtl"), library);
    assert_eq!(listing(folder), ["a_b.mtl", "a_b.obj", "scene.toml"]);
}

#[test]
fn a_file_that_cannot_hold_the_result_is_refused() {
    let folder = folder();
    put(folder.path(), "x.mtl", SCENE);
    for (line, status, words) in [
        ("export x.mtl -o x.obj", 2, "x.mtl|input"),
        ("export -o -", 2, "two files"),
        ("export -o scene.toml", 2, "ends in .obj"),
        ("export -o missing/cuboid.obj", 1, "missing"),
    ] {
        assert_failed(&run(folder.path(), line), status, words);
    }
    assert_eq!(listing(folder.path()), ["x.mtl"]);
    assert_eq!(get(folder.path(), "x.mtl"), SCENE.as_bytes());
}
