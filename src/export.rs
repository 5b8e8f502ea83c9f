//! A scene as Wavefront OBJ and its material library, for other renderers.
//!
//! ```text
//! FILE.obj   o NAME   v: 8 corners   vn: 8 corner normals or 6 face normals   f: 12 triangles, corner//normal
//! FILE.mtl   newmtl NAME   Ka Kd Ks Ns: the coefficients and the exponent of the model
//! ```
//! OBJ has neither lights nor cameras, so those are comments. Each number is the shortest that is read back as the same f64.

use std::path::Path;

use anyhow::ensure;
use glam::DVec3;

use crate::components::{
    FACES, LightKind, Mesh, NormalMode, TRIANGLES, Transform, View, outward_sign,
};
use crate::drawing::{Drawing, camera_name};
use crate::output::{Output, one_line, say};
use crate::report::words::counted;
use crate::scene::{CuboidRecord, SceneRecord};

/// Writes the cuboids of a drawing into `path` and their materials beside it, with the ending .mtl.
///
/// # Errors
/// If `path` ends in .mtl itself, or a file cannot be written.
pub fn run(drawing: &Drawing, path: &Path) -> anyhow::Result<()> {
    let library = path.with_extension("mtl");
    ensure!(library != path, "the materials go into {}", one_line(path));
    let (record, view) = (SceneRecord::of(&drawing.scene.world), drawing.view());
    let names = names(&record);
    let file = library.file_name().map(one_line).unwrap_or_default();
    let mut lines = comments(drawing, &record, &view);
    lines.push(format!("mtllib {file}"));
    let mut firsts = [1, 1];
    for (cuboid, name) in record.cuboid.iter().zip(&names) {
        object(&mut lines, cuboid, name, view.turned, &mut firsts);
    }
    Output::File(library.clone()).write(text(&materials(&record, &names)))?;
    Output::File(path.to_owned()).write(text(&lines))?;
    let cuboids = counted(record.cuboid.len(), "cuboid");
    say(&format!(
        "wrote {cuboids} to {}, the materials to {}",
        one_line(path),
        one_line(library)
    ));
    Ok(())
}

/// Names without blanks, which OBJ does not allow. Each is another one.
fn names(record: &SceneRecord) -> Vec<String> {
    let legal = |letter: char| letter.is_alphanumeric() || "-_.".contains(letter);
    let mut names = Vec::new();
    for (number, cuboid) in record.cuboid.iter().enumerate() {
        let mut name = cuboid.name.replace(|letter| !legal(letter), "_");
        if name.is_empty() || names.contains(&name) {
            name = format!("{name}_{}", number + 1);
        }
        names.push(name);
    }
    names
}

/// Three numbers with a blank before each; -0 is 0.
fn three(vector: DVec3) -> String {
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
            three(camera.position),
            three(camera.target),
            three(camera.up),
            camera.fov,
            camera.height,
            camera.near(),
        ),
        format!("# background{} (levels of 255)", three(record.background)),
    ];
    for light in record.light.iter().filter(|light| light.on) {
        let kind = match light.kind {
            LightKind::Ambient => "ambient",
            LightKind::Diffuse => "diffuse",
            LightKind::Specular => "specular",
        };
        let levels = three(light.color * light.intensity * light.gain);
        let place = light.position.map(|at| format!(", position{}", three(at)));
        let place = place.unwrap_or_default();
        let name = one_line(&light.name);
        lines.push(format!("# light {name}: {kind}, levels{levels}{place}"));
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
    let corners = mesh.corners.map(|corner| position + axes * corner);
    let normals: Vec<DVec3> = match cuboid.normals {
        NormalMode::Corner => mesh.normals.map(|normal| axes * normal).to_vec(),
        NormalMode::Face => (0..FACES.len())
            .map(|face| axes.col(face / 2) * outward_sign(face))
            .collect(),
    };
    lines.extend([format!("o {name}"), format!("usemtl {name}")]);
    lines.extend(corners.iter().map(|it| format!("v{}", three(*it))));
    lines.extend(normals.iter().map(|it| format!("vn{}", three(*it))));
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
    let materials = record.cuboid.iter().zip(names);
    let materials = materials.flat_map(|(cuboid, name)| {
        let it = &cuboid.material;
        [
            format!("newmtl {name}"),
            format!("Ka{}", three(it.ambient)),
            format!("Kd{}", three(it.diffuse)),
            format!("Ks{}", three(it.specular)),
            format!("Ns {}", it.shininess),
            "illum 2".to_owned(),
        ]
    });
    materials.collect()
}
