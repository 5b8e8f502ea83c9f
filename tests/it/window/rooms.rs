//! Rooms of the window by themselves: document, canvas and study.

use std::sync::Arc;
use std::time::Duration;

use egui::{Pos2, Rect};
use fearless_simd::Level;
use shadetrade::components::NormalMode::Face;
use shadetrade::components::ShadingMode::Phong;
use shadetrade::components::{Light, Side, View, ViewMode, ordered, viewer_mut};
use shadetrade::output::paint::area;
use shadetrade::scene::SceneRecord;
use shadetrade::systems::frame::Workers;
use shadetrade::window::canvas::{Canvas, REST};
use shadetrade::window::desk::Desk;
use shadetrade::window::document::{Document, has_edits};
use shadetrade::window::facts::Comparison;
use shadetrade::window::facts::{Change, Facts, change};
use shadetrade::window::keys::EXACT_SIDES;
use shadetrade::window::study::{Runner, Study, Subject};

use super::default_record;
use crate::support::window::default_scene;

const VIEW: [usize; 2] = [64, 48];

/// The default scene after a change, as it is written down.
fn record_after(edit: impl FnOnce(&mut SceneRecord)) -> Arc<SceneRecord> {
    let mut record = default_record();
    edit(&mut record);
    Arc::new(record)
}

#[test]
fn a_document_notes_edits_names_what_is_undone_and_takes_back_what_no_scene_may_have() {
    let mut document = Document::of(default_scene());
    let start = Arc::clone(&document.state);
    document.keep(Duration::ZERO, true);
    for light in document.scene.world.query_mut::<&mut Light>() {
        light.gain += 1.0;
    }
    assert_eq!(document.note(), None);
    document.keep(Duration::from_secs(1), true);
    assert!(document.is_edited() && document.title().contains('*'));
    assert_eq!(document.travel(true), "undo: light.*.gain");
    assert_eq!(document.note(), None);
    assert_eq!(document.state, start);
    assert_eq!(document.travel(false), "redo: light.*.gain");
    document.note();
    let edited = Arc::clone(&document.state);
    viewer_mut(&mut document.scene.world).tolerance = -1.0;
    let reason = document.note().expect("it is refused");
    assert!(reason.contains("tolerance"), "{reason}");
    assert_eq!(SceneRecord::of(&document.scene.world), *edited);
}

#[test]
fn a_document_notes_a_removed_light_once() {
    let mut document = Document::of(default_scene());
    let world = &mut document.scene.world;
    let light = ordered::<Light>(world)[0];
    world.despawn(light).expect("it is there");
    document.note();
    let state = Arc::clone(&document.state);
    assert_eq!(state.light.len(), 3);
    document.note();
    assert!(Arc::ptr_eq(&document.state, &state));
}

#[test]
fn looking_is_no_edit_and_any_other_change_is() {
    type Edit = fn(&mut SceneRecord);
    let saved = record_after(|_| ());
    let is_edit = |edit: Edit| has_edits(&record_after(edit), &saved);
    let looking: [Edit; 5] = [
        |it| it.light[0].on ^= true,
        |it| it.cuboid[0].shading = Phong,
        |it| it.cuboid[0].normals = Face,
        |it| it.camera[0].orbit.azimuth = 2.0,
        |it| it.view.tolerance = 2.0,
    ];
    let edits: [Edit; 5] = [
        |it| it.background.x = 2.0,
        |it| it.light[0].gain = 2.0,
        |it| it.cuboid[0].size.x = 2.0,
        |it| it.camera[0].fov = 2.0,
        |it| drop(it.light.pop()),
    ];
    assert_eq!(looking.map(is_edit), [false; 5]);
    assert_eq!(edits.map(is_edit), [true; 5]);
}

#[test]
fn a_canvas_finds_its_pixels_at_their_places() {
    let mut canvas = Canvas::new(Workers::alone(Level::new()));
    canvas.place = Rect::from_min_max(Pos2::new(10.0, 20.0), Pos2::new(42.0, 44.0));
    canvas.scale = 2.0;
    assert_eq!(canvas.size(), VIEW);
    assert_eq!(canvas.place_of([1, 0]), Pos2::new(10.75, 20.25), "middle");
    for pixel in [[0, 0], [63, 0], [17, 30], [63, 47]] {
        assert_eq!(canvas.pixel_at(canvas.place_of(pixel)), pixel);
    }
    let nearest = canvas.pixel_at(Pos2::new(-5.0, 100.0));
    assert_eq!(nearest, [0, 47]);
}

#[test]
fn a_canvas_tells_the_time_of_a_frame_when_the_next_is_to_be_drawn() {
    let [state, other] = [(); 2].map(|()| record_after(|_| ()));
    let view = View::of(&state.spawn(), VIEW);
    let mut canvas = Canvas::new(Workers::alone(Level::new()));
    assert_eq!(canvas.last_frame(&state), None);
    canvas.drawn = Some((Arc::clone(&state), view));
    canvas.pictures.time = Some(5.0);
    assert_eq!(canvas.last_frame(&other), Some(5.0));
    assert_eq!(canvas.last_frame(&state), None, "nothing is to be drawn");
}

#[test]
fn a_canvas_draws_a_view_of_another_size_and_rests_after_a_pause() {
    let state = record_after(|_| ());
    let mut world = state.spawn();
    let mut canvas = Canvas::new(Workers::alone(Level::new()));
    let mut now = Duration::ZERO;
    for size in [VIEW, [32, 24]] {
        let view = View::of(&world, size);
        for pause in [Duration::ZERO, REST / 2, REST / 2] {
            now += pause;
            assert!(pause.is_zero() || !canvas.rests());
            canvas.rest(now);
            let drawn = canvas.draw(now, &mut world, &state, view);
            drawn.expect("a small picture fits");
            assert_eq!(canvas.pictures.frame.size(), size);
        }
        assert!(canvas.rests());
    }
}

#[test]
fn a_canvas_shows_the_comparison_of_the_present_picture_alone() {
    let [exact, error_map] = [0x00ff_0000, 0x0000_00ff];
    let mut facts = Facts::default();
    let all = VIEW[0] * VIEW[1];
    let filled = |pixel: u32| vec![pixel; all];
    for (show, turn, pixel, count) in [
        (ViewMode::Error, None, error_map, all),
        (ViewMode::Picture, Some(0), exact, all),
        (ViewMode::Wipe, None, exact, all / 2),
    ] {
        let state = record_after(|it| (it.view.show, it.view.sides) = (show, EXACT_SIDES));
        let mut world = state.spawn();
        let mut canvas = Canvas::new(Workers::alone(Level::new()));
        canvas.place = area(VIEW);
        let view = View::of(&world, VIEW);
        let drawn = canvas.draw(Duration::ZERO, &mut world, &state, view);
        drawn.expect("a small picture fits");
        facts.comparison.finish(Some(Comparison {
            exact: filled(exact),
            error_map: filled(error_map),
            ..Comparison::default()
        }));
        let found = |facts: &Facts| {
            let shown = canvas.shown(&state.view, facts, turn);
            shown.iter().filter(|it| **it == pixel).count()
        };
        assert_eq!(found(&facts), count);
        facts.comparison.is_current = false;
        assert_eq!(found(&facts), 0);
    }
}

#[test]
fn squares_tint_the_cuboid_and_nothing_else() {
    let state = record_after(|it| it.view.show = ViewMode::Tiles);
    let mut world = state.spawn();
    let mut canvas = Canvas::new(Workers::alone(Level::new()));
    let view = View::of(&world, VIEW);
    let drawn = canvas.draw(Duration::ZERO, &mut world, &state, view);
    drawn.expect("a small picture fits");
    let frame = canvas.pictures.frame.pixels();
    let facts = Facts::default();
    let shown = canvas.shown(&state.view, &facts, None);
    for (shown, drawn) in shown.iter().zip(frame) {
        assert_eq!(shown == drawn, *drawn == frame[0], "{shown:06x}");
    }
}

#[test]
fn a_change_is_as_great_as_the_facts_that_it_outdates() {
    let before = record_after(|_| ());
    let view = |record: &SceneRecord| View::of(&record.spawn(), VIEW);
    let by = |edit: fn(&mut SceneRecord)| {
        let after = record_after(edit);
        change((&before, &view(&before)), (&after, &view(&after)))
    };
    assert_eq!(by(|_| ()), Change::Nothing);
    assert_eq!(by(|it| it.view.budget = Some(2.0)), Change::Nothing);
    assert_eq!(by(|it| it.view.pixel = Some([0.1; 2])), Change::Nothing);
    assert_eq!(by(|it| it.view.show = ViewMode::Error), Change::Nothing);
    assert_eq!(by(|it| it.view.sides = EXACT_SIDES), Change::Nothing);
    assert_eq!(by(|it| it.view.divider = 0.25), Change::Nothing);
    assert_eq!(by(|it| it.view.tolerance = 1.0), Change::Method);
    assert_eq!(by(|it| it.cuboid[0].shading = Phong), Change::Method);
    assert_eq!(by(|it| it.light[0].on = false), Change::Scene);
    assert_eq!(by(|it| it.camera[0].orbit.azimuth = 1.0), Change::Scene);
    assert_eq!(by(|it| it.cuboid[0].size.x = 1.0), Change::Scene);
    assert_eq!(by(|it| it.cuboid[0].normals = Face), Change::Scene);
    let wide = View::of(&before.spawn(), [80, 48]);
    let same = (&before, &view(&before));
    assert_eq!(change(same, (&before, &wide)), Change::Scene);
}

#[test]
fn a_study_keeps_the_answers_about_a_row_and_forgets_those_about_another() {
    let record = record_after(|it| it.view.pixel = Some([0.0; 2]));
    let mut study = Study::new(Runner::AtOnce).expect("it takes no threads");
    let subject = Subject {
        name: "default",
        record: &record,
        view: View::of(&record.spawn(), VIEW),
        fit: 1.0,
        pixel: None,
        method: None,
        workers: &Workers::alone(Level::new()),
        rests: false,
    };
    for (pixel, side, row) in [
        ([32, 24], Side::Picture, 24),
        ([33, 24], Side::Picture, 24),
        ([33, 25], Side::Picture, 25),
        ([33, 25], Side::Reference, 25),
    ] {
        let asked = Subject {
            pixel: Some((pixel, side)),
            ..subject
        };
        study.ask(&asked, &Desk::default());
        let (of, probes) = study.facts.section.current().expect("an answer");
        assert!(*of == side && probes.iter().all(|it| it.pixel[1] == row));
        assert!(study.facts.probed(Some(pixel)).is_some());
    }
}
