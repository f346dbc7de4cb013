//! The scale that is guessed where nobody gives one.

use trodden::plan::{PlanOptions, ScaleSource, read};

use super::buildings::{flat, office};
use super::canvas::{line, lines, outline, rectangle, text};
use super::mixed_walls::{Fill, PX_PER_M, six_rooms};
use super::styles::{Case, STYLES, Style, draw};

/// Drawings without a scale of their own; the finest take long.
fn unscaled(buildings: &[fn() -> super::buildings::Building]) -> Vec<Case> {
    let styles = || STYLES.into_iter().filter(|style| style.px_per_m <= 50.0 && style.px_per_m != 20.0);
    buildings.iter().flat_map(|&building| styles().map(move |style| Case { style, building, seed: 0 })).collect()
}

#[test]
fn scales_are_guessed_within_a_tenth() {
    let (mut all, mut near, mut told, mut missed) = (0, 0, 0, Vec::new());
    // The office in some styles: it is large.
    let of_office = unscaled(&[office]).into_iter().step_by(5);
    for case in unscaled(&[flat]).into_iter().chain(of_office) {
        let drawn = draw(&case);
        let folder = tempfile::tempdir().unwrap();
        let path = drawn.save(folder.path());
        let name = format!("{}, {}", (case.building)().name, case.style.name);
        let Ok(plan) = read(&path, &PlanOptions::default()) else {
            missed.push(format!("{name}: not read"));
            all += 1;
            continue;
        };
        let (found, truth) = (plan.metres_per_pixel, drawn.truth.metres_per_pixel);
        let is_near = (found / truth - 1.0).abs() <= 0.1;
        let [low, high] = plan.scale.range;
        all += 1;
        near += usize::from(is_near);
        told += usize::from((low..=high).contains(&truth));
        println!("{name}: {:+.1} %", (found / truth - 1.0) * 100.0);
        if !is_near || !(low..=high).contains(&truth) {
            missed.push(format!("{name}: {found} for {truth:.5}, {low:.5} to {high:.5}, by {}", plan.scale.evidence));
        }
        assert_ne!(plan.scale.source, ScaleSource::Given);
        assert!(plan.warnings.iter().any(|w| w.contains("no scale was given")), "{name}");
    }
    println!("{near} of {all} near, {told} of {all} within the range\n{}", missed.join("\n"));
    assert!(near * 10 >= all * 9, "{near} of {all} within a tenth:\n{}", missed.join("\n"));
    assert!(told * 20 >= all * 19, "{told} of {all} within the range:\n{}", missed.join("\n"));
}

/// Styles with printed numbers, at a scale that doors alone do not tell: digits are 9 pixels high and more.
fn numbered(building: fn() -> super::buildings::Building, names: &[&str]) -> Vec<Case> {
    let styles = STYLES.into_iter().filter(|style| names.contains(&style.name));
    styles.map(|style| Case { style: Style { px_per_m: 53.0, ..style }, building, seed: 0 }).collect()
}

fn scale_of(case: &Case) -> (f64, trodden::plan::PlanScale) {
    let drawn = draw(case);
    let folder = tempfile::tempdir().unwrap();
    let plan = read(&drawn.save(folder.path()), &PlanOptions::default()).unwrap();
    (plan.metres_per_pixel / drawn.truth.metres_per_pixel - 1.0, plan.scale)
}

#[test]
fn printed_dimensions_and_areas_give_the_scale_to_two_percent() {
    let dimensions = ["CAD export", "layer colours", "walls of one pixel, arrows", "walls of one pixel, dots"];
    let areas = ["doors closed by a line", "dark background", "brochure"];
    for case in numbered(office, &[&dimensions[..], &areas].concat()) {
        let (off, scale) = scale_of(&case);
        println!("{}: {:+.2} %, by {}", case.style.name, off * 100.0, scale.evidence);
        assert!(off.abs() <= 0.02, "{}: {off}, {scale:?}", case.style.name);
        assert_eq!(scale.source, ScaleSource::Printed, "{}: {scale:?}", case.style.name);
    }
}

#[test]
fn numbers_that_contradict_each_other_do_not_change_the_scale() {
    let case = numbered(office, &["doors closed by a line"])[0];
    let without = Style { names: false, ..case.style };
    let wrong = Style { wrong_areas: true, ..case.style };
    let [without, wrong] = [without, wrong].map(|style| scale_of(&Case { style, ..case }));
    assert_eq!(wrong.1.source, ScaleSource::Guessed, "{wrong:?}");
    assert!((wrong.0 - without.0).abs() < 0.03, "{wrong:?} and {without:?}");
}

#[test]
fn the_buildings_width_gives_the_scale() {
    let (mut all, mut near, mut missed) = (0, 0, Vec::new());
    for case in unscaled(&[flat]) {
        let drawn = draw(&case);
        let folder = tempfile::tempdir().unwrap();
        let path = drawn.save(folder.path());
        let width = drawn.image.width() as usize;
        let columns: Vec<usize> =
            (0..drawn.truth.wall.len()).filter(|&at| drawn.truth.wall[at] != 0).map(|at| at % width).collect();
        let extent = columns.iter().max().unwrap() + 1 - columns.iter().min().unwrap();
        let width_m = extent as f64 * drawn.truth.metres_per_pixel;
        let options = PlanOptions { width_m: Some(width_m), ..PlanOptions::default() };
        let name = format!("{}, {}", (case.building)().name, case.style.name);
        all += 1;
        match read(&path, &options) {
            Ok(plan) if (plan.metres_per_pixel / drawn.truth.metres_per_pixel - 1.0).abs() <= 0.02 => near += 1,
            Ok(plan) => missed.push(format!("{name}: {} for {}", plan.metres_per_pixel, drawn.truth.metres_per_pixel)),
            Err(error) => missed.push(format!("{name}: {error}")),
        }
    }
    println!("{near} of {all} within 2 %");
    assert!(near * 20 >= all * 19, "{near} of {all} within 2 %:\n{}", missed.join("\n"));
}

/// Scale bars of rooms twice as large as their doors say, below and beside them: numbers along a bar of boxes, nine pixels high,
/// and a length alone at a line. The scale was that of the doors.
#[test]
fn scale_bars_are_believed_against_doors() {
    const LARGER: f64 = 2.0;
    let black = [0; 3];
    for is_ruled in [false, true] {
        let mut canvas = six_rooms(Fill::None);
        let (x, y, metre) = (0.5, 9.2, 1.0 / LARGER);
        if is_ruled {
            let ends = [x, x + 10.0 * metre];
            canvas.fill(&lines(&ends.map(|x| [x, y]), 0.04), black);
            canvas.fill(&ends.map(|x| line([x, y - 0.1], [x, y + 0.1], 0.04)), black);
            canvas.fill(&text("10 m", [x + 5.0 * metre, y - 0.25], 0.22, 0.035), black);
        } else {
            for (k, number) in [(0.0, "0"), (5.0, "5"), (10.0, "10"), (20.0, "20 m")] {
                let middle = if k == 20.0 { 0.15 } else { 0.0 };
                canvas.fill(&text(number, [x + k * metre + middle, y - 0.25], 0.19, 0.03), black);
            }
            canvas.fill(&outline(&rectangle([x, y], [x + 20.0 * metre, y + 0.2]), 0.03), black);
            canvas.fill(&[0.0, 10.0].map(|k| rectangle([x + k * metre, y], [x + (k + 5.0) * metre, y + 0.2])), black);
        }
        let plan = canvas.read(None);
        let off = plan.metres_per_pixel * PX_PER_M / LARGER - 1.0;
        assert!(off.abs() < 0.02, "ruled: {is_ruled}: {off}, by {}", plan.scale.evidence);
        assert_eq!((plan.scale.source, plan.doors.len()), (ScaleSource::Printed, 6), "ruled: {is_ruled}");
    }
}
