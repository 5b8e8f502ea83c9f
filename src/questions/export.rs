//! A scene as Wavefront OBJ and its material library, for other renderers.
//!
//! ```text
//! FILE.obj   o NAME   v: 8 corners   vn: 8 corner normals or 6 face normals   f: 12 triangles, corner//normal
//!            with several segments: for each face the points of its grid, and the triangles of its cells
//! FILE.mtl   newmtl NAME   Ka Kd Ks Ns: the coefficients and the exponent of the model
//! ```
//! OBJ has neither lights nor cameras, so those are comments. Each number is the shortest that is read back as the same f64.

use std::collections::{HashMap, HashSet};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use anyhow::ensure;
use glam::DVec3;

use crate::components::{FACES, Mesh, NormalMode, Normals, TRIANGLES, Transform, View, unit};
use crate::output::files::{folder_of, write_all};
use crate::output::words::counted;
use crate::output::{one_line, say};
use crate::questions::job::{Drawing, camera_name};
use crate::scene::{CuboidRecord, SceneRecord};

/// The file of the materials: beside the OBJ file, with the ending .mtl and a name without blanks, at which readers split.
pub fn library(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(without_blanks(&stem) + ".mtl")
}

/// Writes the cuboids of a drawing into `path`, and their materials into its [`library`].
///
/// # Errors
/// If a file cannot be written.
pub fn run(drawing: &Drawing, path: &Path) -> anyhow::Result<()> {
    let library = library(path);
    let (record, view) = (SceneRecord::of(&drawing.scene.world), drawing.view());
    let names = names(&record);
    let file = library.file_name().map(one_line).unwrap_or_default();
    let mut lines = comments(drawing, &record, &view);
    lines.push(format!("mtllib {file}"));
    let mut firsts = [1, 1];
    for (cuboid, name) in record.cuboid.iter().zip(&names) {
        object(&mut lines, cuboid, name, view.turned, &mut firsts);
    }
    let other = user_of(&library, path).map(one_line);
    ensure!(
        other.is_none(),
        "cannot write {}: {} has its materials there; give -o another name",
        one_line(&library),
        other.unwrap_or_default()
    );
    write_all(&[
        (&*library, text(&materials(&record, &names))),
        (path, text(&lines)),
    ])?;
    let cuboids = counted(record.cuboid.len(), "cuboid");
    say(&format!(
        "wrote {cuboids} to {}, the materials to {}",
        one_line(path),
        one_line(library)
    ));
    Ok(())
}

/// Another OBJ file beside `path` that names this library, if the library exists.
fn user_of(library: &Path, path: &Path) -> Option<PathBuf> {
    if !library.exists() {
        return None;
    }
    let name = library.file_name()?;
    let names_it = |file: &PathBuf| {
        let opened = File::open(file).map(|file| BufReader::new(file).lines());
        let lines = opened.into_iter().flatten().map_while(Result::ok);
        // The library is named before the first face that has a material.
        let mut head = lines.take_while(|line| !line.starts_with("f "));
        head.any(|line| line.strip_prefix("mtllib ").map(str::trim) == name.to_str())
    };
    let beside = fs::read_dir(folder_of(path)).ok()?.flatten();
    beside.map(|it| it.path()).find(|file| {
        let is_obj = file
            .extension()
            .is_some_and(|it| it.eq_ignore_ascii_case("obj"));
        is_obj && file.file_name() != path.file_name() && names_it(file)
    })
}

fn without_blanks(name: &str) -> String {
    let legal = |letter: char| letter.is_alphanumeric() || "-_.".contains(letter);
    name.replace(|letter| !legal(letter), "_")
}

/// Names without blanks, each another one.
fn names(record: &SceneRecord) -> Vec<String> {
    let mut names = Vec::with_capacity(record.cuboid.len());
    let mut taken = HashSet::new();
    // The last number of each name, so that the next search begins there.
    let mut numbers: HashMap<String, usize> = HashMap::new();
    for cuboid in &record.cuboid {
        let own = without_blanks(&cuboid.name);
        let number = numbers.entry(own.clone()).or_insert(1);
        let mut name = own.clone();
        while name.is_empty() || !taken.insert(name.clone()) {
            *number += 1;
            name = format!("{own}_{number}");
        }
        names.push(name);
    }
    names
}

/// The numbers of a vector with a blank before each; -0 is 0.
fn numbers(vector: DVec3) -> String {
    let [x, y, z] = (vector + DVec3::ZERO).to_array();
    format!(" {x} {y} {z}")
}

fn text(lines: &[String]) -> String {
    lines.join("\n") + "\n"
}

/// The scene, its camera and its lights.
fn comments(drawing: &Drawing, record: &SceneRecord, view: &View) -> Vec<String> {
    let camera = &view.camera;
    let mut lines = vec![
        format!("# shadetrade: {}", one_line(&drawing.scene.name)),
        format!(
            "# camera {}: {}, position{}, target{}, up{}, fov {} (vertical, degrees), height {}, near {}",
            one_line(camera_name(&drawing.scene.world)),
            view.projection.name(),
            numbers(camera.position),
            numbers(camera.target),
            numbers(camera.up),
            camera.fov,
            camera.height,
            camera.near(),
        ),
        format!("# background{} (levels of 255)", numbers(record.background)),
    ];
    for light in record.light.iter().filter(|light| light.on) {
        let levels = numbers(light.color * light.intensity * light.gain);
        let position = match light.position {
            Some(at) => format!(", position{}", numbers(at)),
            None => String::new(),
        };
        let name = one_line(&light.name);
        let kind = light.kind.name();
        lines.push(format!("# light {name}: {kind}, levels{levels}{position}"));
    }
    lines
}

/// Adds a cuboid. `corner` and `normal` are the numbers of its first corner and of its first normal.
fn object(
    lines: &mut Vec<String>,
    cuboid: &CuboidRecord,
    name: &str,
    turned: u32,
    [corner, normal]: &mut [usize; 2],
) {
    let (position, rotation) = (cuboid.position, cuboid.rotation);
    let axes = Transform { position, rotation }.turned(turned).axes();
    let mesh = Mesh::cuboid(cuboid.size);
    let shading = cuboid.shading.name();
    lines.push(format!("# the next is shaded by {shading}"));
    lines.extend([format!("o {name}"), format!("usemtl {name}")]);
    let normals = Normals::new(cuboid.normals, &mesh, axes);
    let count = cuboid.segments.count();
    if count > 1 {
        let grid = || cuboid.segments.grid();
        for face in 0..FACES.len() {
            let own = normals.of_face(face);
            for (place, normal) in grid().map(|(_, uv)| mesh.on_face(face, &own, uv)) {
                lines.push(format!("v{}", numbers(position + axes * place)));
                lines.push(format!("vn{}", numbers(unit(normal))));
            }
            let name = |[i, j]: [usize; 2]| {
                let point = j * (count + 1) + i;
                format!("{}//{}", *corner + point, *normal + point)
            };
            let points = grid().map(|(point, _)| point);
            let cells = points.filter(|it| !it.contains(&count));
            for [a, b, c, d] in cells.map(|cell| Mesh::cell(face, cell).map(name)) {
                lines.extend([format!("f {a} {b} {c}"), format!("f {a} {c} {d}")]);
            }
            *corner += cuboid.segments.points();
            *normal += cuboid.segments.points();
        }
        return;
    }
    let corners = mesh.corners.map(|corner| position + axes * corner);
    let normals = match normals {
        Normals::Corner(normals) => normals.to_vec(),
        faces @ Normals::Face(_) => (0..FACES.len())
            .map(|face| faces.of_face(face)[0])
            .collect(),
    };
    lines.extend(corners.iter().map(|it| format!("v{}", numbers(*it))));
    lines.extend(normals.iter().map(|it| format!("vn{}", numbers(*it))));
    for (triangle, vertices) in TRIANGLES.iter().enumerate() {
        let [a, b, c] = vertices.map(|vertex| {
            let vertex = usize::from(vertex);
            let own = match cuboid.normals {
                NormalMode::Corner => vertex,
                NormalMode::Face => triangle / 2,
            };
            format!("{}//{}", *corner + vertex, *normal + own)
        });
        lines.push(format!("f {a} {b} {c}"));
    }
    *corner += corners.len();
    *normal += normals.len();
}

/// The lines of the material library.
fn materials(record: &SceneRecord, names: &[String]) -> Vec<String> {
    let lines = record.cuboid.iter().zip(names).flat_map(|(cuboid, name)| {
        let it = &cuboid.material;
        [
            format!("newmtl {name}"),
            format!("Ka{}", numbers(it.ambient)),
            format!("Kd{}", numbers(it.diffuse)),
            format!("Ks{}", numbers(it.specular)),
            format!("Ns {}", it.shininess),
            "illum 2".to_owned(),
        ]
    });
    lines.collect()
}
