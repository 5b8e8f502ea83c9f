//! The window without a display, and the positions of its widgets by label.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Pos2, UiBuilder};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use fearless_simd::Level;
use shadetrade::components::{Viewer, viewer_mut};
use shadetrade::questions::job::Drawing;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::window::{app::App, study::Runner, widgets};

/// The built-in scene as it opens.
pub fn first_scene() -> Scene {
    Scene::load(None).expect("the built-in scene is valid")
}

/// The built-in scene, without a view of its own: its picture is shown.
pub fn default_scene() -> Scene {
    let mut scene = first_scene();
    *viewer_mut(&mut scene.world) = Viewer::default();
    scene.record = Arc::new(SceneRecord::of(&scene.world));
    scene
}

/// A window on `scene`. Its questions about the picture are answered at once.
pub fn app(scene: Scene, size: [usize; 2], level: Level) -> App {
    let drawing = Drawing {
        scene,
        size,
        threads: 1,
        level,
    };
    let mut app = App::new(drawing, Runner::AtOnce).expect("one thread is always there");
    app.desk.shows_times = false;
    app
}

/// The widgets of a window of `size` pixels, with the layout of the real window.
pub fn widgets(app: App, size: [usize; 2]) -> Harness<'static, App> {
    let builder = Harness::builder().with_size(size.map(|side| side as f32));
    let mut harness = builder.build_ui_state(
        |ui, app: &mut App| {
            widgets::apply_style(ui.ctx());
            let all = UiBuilder::new().max_rect(ui.ctx().content_rect());
            ui.scope_builder(all, |ui| app.ui(ui));
        },
        app,
    );
    harness.run_ok();
    harness
}

/// The centre of each widget with this label, without the key beside it.
pub fn places(harness: &Harness<App>, label: &str) -> Vec<Pos2> {
    let is_named = |own: &str| {
        own.strip_prefix(label)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    };
    let all = harness.query_all_by(|node| node.role() != Role::Label);
    let named = all.filter(|node| {
        node.accesskit_node()
            .label()
            .is_some_and(|own| is_named(&own))
    });
    named.map(|node| node.rect().center()).collect()
}
