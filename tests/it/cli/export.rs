//! The command `export`, read back by an independent reader of OBJ.

use glam::DVec3;
use shadetrade::components::{
    FACES, Material, Mesh, NormalMode, TRIANGLES, Transform, in_file_order,
};
use shadetrade::scene::{self, Scene, SceneRecord};
use tobj::{GPU_LOAD_OPTIONS, LoadOptions};

use super::{SCENE, assert_failed, assert_works, cube, folder, get, listing, put, run, shadetrade};
use crate::support::records;

type Parts<'a> = (&'a Transform, &'a Mesh, &'a NormalMode, &'a Material);

/// The default scene, with a second cuboid that is turned and has face normals.
fn two() -> String {
    let mut record = SceneRecord::of(&Scene::load(None).expect("it is built in").world);
    let mut other = records::cuboid("a second, sharp", [1.0, 2.0, 0.3], [0.1, 5.0, 0.7]);
    (other.rotation, other.normals) = (DVec3::new(10.0, 20.0, 30.0), NormalMode::Face);
    record.cuboid.push(other);
    scene::updated("", &record)
}

fn three(numbers: &[f64], index: u32) -> DVec3 {
    DVec3::from_slice(&numbers[3 * index as usize..])
}

#[test]
fn an_exported_scene_is_read_back_bit_for_bit() {
    let folder = folder();
    put(folder.path(), "two.toml", two());
    let path = folder.path().join("two.toml");
    assert_works(folder.path(), "export two.toml -o two.obj");
    let file = folder.path().join("two.obj");
    let (models, materials) = tobj::load_obj(&file, &LoadOptions::default()).expect("an OBJ file");
    let materials = materials.expect("a material library");
    let scene = Scene::load_path(&path).expect("a scene");
    let cuboids = in_file_order::<Parts, _>(&scene.world, |(at, mesh, mode, material)| {
        (*at, *mesh, *mode, *material)
    });
    assert_eq!([models.len(), materials.len()], [2, 2]);
    for ((model, library), (at, mesh, mode, material)) in models.iter().zip(&materials).zip(cuboids)
    {
        let (axes, read) = (at.axes(), &model.mesh);
        assert_eq!(read.indices.len(), 36);
        for (triangle, vertices) in TRIANGLES.iter().enumerate() {
            for (corner, vertex) in vertices.map(usize::from).into_iter().enumerate() {
                let index = 3 * triangle + corner;
                let place = three(&read.positions, read.indices[index]);
                assert_eq!(place, at.position + axes * mesh.corners[vertex]);
                let normal = three(&read.normals, read.normal_indices[index]);
                // The face's edges from its first corner, counter-clockwise seen from outside.
                let [a, b, _, d] =
                    FACES[triangle / 2].map(|it| axes * mesh.corners[usize::from(it)]);
                let expected = match mode {
                    NormalMode::Corner => axes * mesh.normals[vertex],
                    NormalMode::Face => (b - a).cross(d - a).normalize(),
                };
                assert!(
                    (normal - expected).length() < 1e-15,
                    "{mode:?}: {normal} for {expected}"
                );
            }
        }
        let coefficients = [library.ambient, library.diffuse, library.specular];
        let expected = [material.ambient, material.diffuse, material.specular];
        assert_eq!(coefficients, expected.map(|it| Some(it.to_array())));
        assert_eq!(library.shininess, Some(material.shininess));
    }
    assert_eq!(models[1].name, "a_second__sharp");
    // An engine that knows one index a vertex reads the same.
    assert!(tobj::load_obj(&file, &GPU_LOAD_OPTIONS).is_ok());
}

#[test]
fn with_segments_each_face_is_exported_as_its_grid() {
    let folder = folder();
    put(folder.path(), "two.toml", two());
    assert_works(folder.path(), "export two.toml --segments 3 -o two.obj");
    let file = folder.path().join("two.obj");
    let (models, _) = tobj::load_obj(&file, &LoadOptions::default()).expect("an OBJ file");
    let scene = Scene::load_path(&folder.path().join("two.toml")).expect("a scene");
    let cuboids =
        in_file_order::<Parts, _>(&scene.world, |(at, mesh, mode, _)| (*at, *mesh, *mode));
    for (model, (at, cuboid, mode)) in models.iter().zip(cuboids) {
        let read = &model.mesh;
        assert_eq!(
            (read.positions.len(), read.indices.len()),
            (3 * 6 * 16, 3 * 6 * 18)
        );
        let mut area = 0.0;
        let own = |world: DVec3| at.axes().transpose() * world;
        for (places, normals) in read.indices.chunks(3).zip(read.normal_indices.chunks(3)) {
            let places = [0, 1, 2].map(|it| own(three(&read.positions, places[it]) - at.position));
            let across = (places[1] - places[0]).cross(places[2] - places[0]);
            area += across.length() / 2.0;
            // A face, and its triangles are counter-clockwise seen from outside.
            let axis = (0..3)
                .find(|axis| across[*axis].abs() > 1e-9)
                .expect("an area");
            let half = cuboid.corners[7];
            for (place, index) in places.into_iter().zip(normals) {
                let out = across[axis].signum();
                assert!((place[axis] - out * half[axis]).abs() < 1e-12);
                let share = place / half;
                let thirds = share.to_array().map(|it| (it + 1.0) * 1.5);
                assert!(
                    thirds.iter().all(|it| (it - it.round()).abs() < 1e-9),
                    "{thirds:?}"
                );
                let expected = match mode {
                    NormalMode::Corner => share.normalize(),
                    NormalMode::Face => across.normalize(),
                };
                assert!((own(three(&read.normals, *index)) - expected).length() < 1e-12);
            }
        }
        let size = cuboid.size();
        let whole = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        assert!((area - whole).abs() < 1e-9, "{area} of {whole}");
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
    assert_eq!(
        listing(folder.path()),
        ["my boxes.obj", "my_boxes.mtl", "three.toml"]
    );
}

#[test]
fn the_library_does_not_replace_the_scene() {
    let folder = folder();
    put(folder.path(), "x.mtl", SCENE);
    assert_failed(
        &run(folder.path(), "export x.mtl -o x.obj"),
        2,
        "x.mtl|input",
    );
    assert_eq!(get(folder.path(), "x.mtl"), SCENE.as_bytes());
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
    for (line, status, words) in [
        ("export -o -", 2, "two files"),
        ("export -o scene.toml", 2, "ends in .obj"),
        ("export -o missing/cuboid.obj", 1, "missing"),
    ] {
        assert_failed(&run(folder.path(), line), status, words);
    }
    assert_eq!(listing(folder.path()), [""; 0]);
}
