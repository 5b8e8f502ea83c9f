//! The two sides of a wipe: their tags, the worst pixel, and the amplified difference.

use std::time::Duration;

use egui::{Key, vec2};
use egui_kittest::kittest::Queryable;
use fearless_simd::Level;
use shadetrade::components::{Probed, ShadingMode, Show, Side, View};
use shadetrade::frame::{Keep, face};
use shadetrade::reference;
use shadetrade::shading::METHODS;
use shadetrade::trade::Measurement;
use shadetrade::trade::metrics::displayed;
use shadetrade::window::app::App;
use shadetrade::window::keys::gouraud_phong;
use shadetrade::window::pictures::side_view;

use super::Window;
use super::widgets::click_at;
use crate::support::scene::draw;
use crate::support::window::{app, default_scene, places, widgets};
use crate::trade::example::live;

const SIZE: [usize; 2] = [1400, 800];
/// A pixel of the cuboid in the left half of the picture, and one in the right half.
const WORST: [[usize; 2]; 2] = [[430, 400], [700, 330]];

/// A window that has measured the methods of a wipe.
fn measured() -> App {
    let mut app = app(default_scene(), SIZE, Level::new());
    app.shows_times = true;
    let methods = METHODS.iter().map(|method| Measurement {
        worst: Some(WORST[usize::from(method.mode == ShadingMode::Gouraud)]),
        highlight_kept: Some(0.1),
        ..live(
            *method,
            0.25,
            if method.mode == ShadingMode::Gouraud {
                165.0
            } else {
                0.5
            },
        )
    });
    app.facts.trade.finish(Some(methods.collect()));
    app
}

fn open() -> Window {
    let mut window = Window::with(measured(), SIZE);
    window.press(Key::F3);
    window.step(Vec::new());
    window
}

fn sides(window: &Window) -> [Side; 2] {
    window.app.look::<Show>().sides
}

#[test]
fn the_menu_in_a_tag_chooses_the_method_of_its_side() {
    let mut harness = widgets(measured(), SIZE);
    harness.key_press(Key::F3);
    harness.run_ok();
    let choices = [
        [
            "Gouraud ⏷",
            "Interpolated unit vectors",
            "phong-unit-vectors",
        ],
        [
            "Phong within half a level ⏷",
            "Exact Phong in f64",
            "reference",
        ],
    ];
    for (index, [from, to, side]) in choices.into_iter().enumerate() {
        for label in [from, to] {
            let found = places(&harness, label);
            click_at(&mut harness, *found.last().expect(label));
        }
        let shown = harness.state().look::<Show>().sides[index];
        assert_eq!(String::from(shown), side);
    }
}

#[test]
fn both_tags_are_whole_in_windows_of_any_width() {
    for size in [SIZE, [760, 700]] {
        let mut harness = widgets(measured(), size);
        harness.key_press(Key::F3);
        harness.run_ok();
        let place = harness.state().place;
        let tags = [
            ["Gouraud ⏷", "worst pixel 165 of 255"],
            ["Phong within half a level ⏷", "worst pixel 0.500 of 255"],
        ];
        let tags = tags.map(|labels| {
            let [name, worst] = labels.map(|label| harness.get_by_label(label).rect());
            name.union(worst)
        });
        assert!(
            tags.iter().all(|tag| place.contains_rect(*tag)),
            "{tags:?} in {place}"
        );
        assert!(tags[0].max.x < tags[1].min.x, "{tags:?}");
    }
}

#[test]
fn two_pictures_take_turns_while_a_key_is_held() {
    for (view, sides) in [
        (Key::F2, [Side::Reference, Side::Picture]),
        (Key::F3, gouraud_phong(0.5)),
        (Key::F4, [Side::Picture, Side::Reference]),
    ] {
        let mut window = Window::of(default_scene(), [300, 200]);
        window.press(view);
        let before = window.app.shown().to_vec();
        window.key(Key::B, true);
        for turn in [0, 1, 0, 1] {
            let expected = match sides[turn] {
                Side::Reference => window.comparison().exact.clone(),
                side => window.drawn(|view| side_view(&side, &view).expect("it is drawn")),
            };
            assert!(window.app.shown() == expected, "{sides:?}, {turn}");
            assert!(window.output.repaint_after <= Duration::from_millis(500));
            window.wait(Duration::from_millis(480));
        }
        window.key(Key::B, false);
        assert!(window.app.shown() == before);
    }
}

#[test]
fn the_worst_pixel_is_probed_by_its_mark_and_its_tag() {
    let probed = |window: &Window| window.app.look::<Probed>().0;
    // Its mark, where its side is shown: Gouraud's lies right of the divider and Phong's left.
    for is_shown in [false, true] {
        for [x, y] in WORST {
            let mut window = open();
            if is_shown {
                let [left, right] = sides(&window);
                window.app.wipe([right, left]);
                window.step(Vec::new());
            }
            window.click(window.app.place_of([x, y]) + vec2(4.0, 3.0));
            assert_eq!(probed(&window) == Some([x, y]), is_shown);
        }
    }
    // Its tag moves the divider off it.
    let mut window = open();
    let mut harness = widgets(measured(), SIZE);
    harness.key_press(Key::F3);
    harness.run_ok();
    let tag = harness.get_by_label("worst pixel 165 of 255").rect();
    window.click(tag.center());
    let divider = window.app.look::<Show>().divider;
    let [width, _] = window.app.picture_size();
    // The inspector opens beside the picture, whose columns move.
    assert_eq!(probed(&window).map(|[_, y]| y), Some(WORST[1][1]));
    assert!(divider > WORST[1][0] as f64 / width as f64, "{divider}");
    // The key chooses the side that errs more.
    let mut window = open();
    window.press(Key::Y);
    assert_eq!(probed(&window).map(|[_, y]| y), Some(WORST[1][1]));
}

#[test]
fn the_amplified_difference_is_the_difference_to_exact_phong() {
    let mut window = Window::of(default_scene(), [400, 300]);
    for key in [Key::P, Key::F5, Key::F5] {
        window.press(key);
    }
    let mut world = window.app.state.spawn();
    let view = View::of(&world, window.app.picture_size());
    let drawn = draw(&mut world, &view, Keep::Levels);
    let exact = reference::picture(&world, &view, 0..view.size[1], &|| false, &|_| ());
    let exact = exact.expect("not cancelled");
    let comparison = window.comparison();
    let largest = comparison.error.expect("a cuboid");
    // Half a level, 256 times: the most that the way from grey to white holds.
    assert!(comparison.amplification * largest <= 127.0 && comparison.amplification == 256.0);
    let (mut most, shown) = (0, window.app.shown());
    for (pixel, shown) in shown.iter().enumerate() {
        let [_, shown @ ..] = shown.to_be_bytes();
        let is_compared = face(drawn.triangles()[pixel]) == face(exact.triangles[pixel]);
        for (channel, shown) in shown.into_iter().enumerate().filter(|_| is_compared) {
            let [one, other] = [
                f64::from(drawn.levels()[pixel][channel]),
                exact.levels[pixel][channel],
            ];
            let expected = 128.0 + 256.0 * (displayed(one) - displayed(other));
            assert!(
                (f64::from(shown) - expected).abs() < 2.0,
                "{shown} for {expected}"
            );
            most = most.max(shown.abs_diff(128));
        }
    }
    assert!(most > 40, "an error below half a level is seen: {most}");
    window.press(Key::F5);
    assert!(window.app.shown() == window.comparison().error_map);
    // The largest power of two that the way from grey to white holds.
    window.app.set_tolerance(4.0);
    window.step(Vec::new());
    let factor = window.comparison().amplification;
    let largest = window.comparison().error.expect("a cuboid");
    assert!((63.5..=127.0).contains(&(factor * largest)), "{factor}");
    window.app.desk.panel_folded = false;
    let harness = widgets(window.app, SIZE);
    let legend = places(&harness, &format!("difference x{factor}"));
    assert_eq!(legend.len(), 1, "the legend has the factor");
}
