//! Each format gives the building that was written.

use trodden::plan::{PlanClass, PlanLayers, PlanOptions, ScaleSource};
use trodden::routes;
use trodden::walls::Walls as TracedWalls;

use super::building::Building;
use super::measure::{Seen, read_with};
use super::write::{self, Walls};

/// Thick outer and thin inner walls, for formats that draw the thickness.
fn office() -> Building {
    Building::new(0.3, 0.12)
}

/// Walls of 0.1 m, for formats of lines.
fn of_lines() -> Building {
    Building::new(0.1, 0.1)
}

fn says(seen: &Seen, words: &str) {
    assert!(seen.plan.warnings.iter().any(|w| w.contains(words)), "{words:?} is missing in {:#?}", seen.plan.warnings);
}

#[test]
fn svg_with_layers_at_1_to_100() {
    let truth = office();
    let seen = Seen::of("plan.svg", write::svg(&truth, 100.0), [2.0, 2.0]);
    seen.check(&truth, "SVG");
    assert_eq!((seen.closed_windows(&truth), seen.desks(&truth)), (12, 12));
    says(&seen, "1:100");
    says(&seen, "12 texts");
}

#[test]
fn svg_of_real_size_without_a_name_and_compressed() {
    use std::io::Write;
    let truth = office();
    let mut zip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    zip.write_all(write::svg(&truth, 1.0).as_bytes()).unwrap();
    Seen::of("plan.svgz", zip.finish().unwrap(), [2.0, 2.0]).check(&truth, "SVGZ of real size");
}

#[test]
fn svg_of_a_building_model_has_the_models_scale_and_storeys() {
    let truth = office();
    let seen = Seen::of("floors.svg", write::svg_of_model(&truth), [30.0, 30.0]);
    // The building's own scale, though its doors are drawn in pieces of 5 cm.
    assert!(seen.iou(&truth) > 0.98 && seen.scale().iter().all(|scale| (scale - 1.0).abs() < 1e-3));
    assert_eq!(seen.rooms_reached(&truth), 12);
    // The two outer doors end the floor: people come and go there.
    assert_eq!(seen.open_doors(&truth), [12, 12]);
    says(&seen, "storey 1 of 2");
    let upper = PlanOptions { page: Some(2), ..PlanOptions::default() };
    let upper = read_with("floors.svg", write::svg_of_model(&truth), &upper).unwrap();
    let floor = upper.floor.iter().filter(|&&floor| floor == 1).count() as f64;
    let floor_m2 = floor * upper.metres_per_pixel * upper.metres_per_pixel;
    assert!((floor_m2 - 8.4 * 5.4).abs() < 1.0, "{floor_m2} m2");
}

#[test]
fn dxf_with_blocks_hatches_and_texts() {
    let truth = office();
    // In the metres of a national grid, as surveyors have it.
    let begins = [3_500_000.0, 5_800_000.0];
    for (unit_m, insunits, walls, what) in [
        (0.001, 4, Walls::Pieces, "DXF in millimetres"),
        (1.0, 6, Walls::Lines, "DXF of lines in metres"),
        (0.0254, 1, Walls::Pieces, "DXF in inches"),
        (0.01, 0, Walls::Lines, "DXF without a unit"),
        (0.001, 6, Walls::Pieces, "DXF with the wrong unit"),
    ] {
        let begins = if unit_m == 1.0 { begins } else { [12.0, -7.0] };
        let seen = Seen::of("plan.dxf", write::dxf(&truth, unit_m, insunits, walls, begins), begins);
        seen.check(&truth, what);
        assert_eq!((seen.closed_windows(&truth), seen.desks(&truth)), (12, 12), "{what}");
        says(&seen, "12 hatches");
        says(&seen, "12 texts");
        says(&seen, "12 hidden entities");
        says(&seen, "12 dimension");
    }
}

#[test]
fn dxf_of_centre_lines_has_walls_of_a_tenth_of_a_metre() {
    let truth = of_lines();
    Seen::of("plan.dxf", write::dxf(&truth, 0.001, 4, Walls::Centre, [0.0, 0.0]), [0.0, 0.0])
        .check(&truth, "DXF centres");
}

#[test]
fn doors_of_a_building_whose_outer_wall_is_a_ring() {
    let truth = office().closed();
    Seen::of("plan.svg", write::svg(&truth, 50.0), [2.0, 2.0]).check(&truth, "SVG of a closed building");
    let seen = Seen::of("plan.dxf", write::dxf(&truth, 0.001, 4, Walls::Pieces, [0.0, 0.0]), [0.0, 0.0]);
    seen.check(&truth, "DXF of a closed building");
}

#[test]
fn pdf_with_layers_and_a_printed_scale() {
    let truth = office();
    let seen = Seen::of("plan.pdf", write::pdf(&truth, true), [2.0, 2.0]);
    seen.check(&truth, "PDF");
    assert_eq!((seen.closed_windows(&truth), seen.desks(&truth)), (12, 12));
    says(&seen, "1:100");
    says(&seen, "1 text");
}

#[test]
fn pdf_without_layers_is_read_as_a_picture_of_the_right_size() {
    let truth = office();
    let seen = read_with("plan.pdf", write::pdf(&truth, false), &PlanOptions::default()).unwrap();
    assert!((seen.metres_per_pixel - 0.02).abs() < 1e-3, "{}", seen.metres_per_pixel);
    assert!(seen.warnings.iter().any(|w| w.contains("as a picture")), "{:?}", seen.warnings);
    // The building with its margin.
    assert!((30.0..33.0).contains(&seen.width_m()) && (18.0..21.0).contains(&seen.height_m()));
}

#[test]
fn open_rmf_building_with_doors_lanes_and_a_measurement() {
    let truth = of_lines();
    // The building begins 100 pixels right and 900 down, at 0.04 m a pixel.
    let seen = Seen::of("office.building.yaml", write::rmf(&truth), [4.0, -36.0]);
    seen.check(&truth, "Open-RMF");
    says(&seen, "1 model");
    let lanes = &seen.plan.drawn.as_ref().unwrap().lanes;
    assert_eq!(lanes.len(), 1);
    assert!((lanes[0][0].distance(lanes[0][1]) - 28.0).abs() < 1e-6);
    assert_eq!(seen.plan.drawn.as_ref().unwrap().doors.len(), 14);
}

#[test]
fn universal_vtt_map_with_portals_and_a_grid() {
    let truth = of_lines();
    let seen = Seen::of("office.uvtt", write::vtt(&truth), [3.0, 3.0]);
    seen.check(&truth, "Universal VTT");
    says(&seen, "1.5 m");
    // The map ends where its grid ends.
    assert!((seen.plan.width_m() - 36.0).abs() < 0.03 && (seen.plan.height_m() - 24.0).abs() < 0.03);
}

#[test]
fn a_given_scale_goes_before_the_drawings_own() {
    let truth = office();
    let options = PlanOptions { metres_per_pixel: Some(0.002), ..PlanOptions::default() };
    let seen = read_with("plan.dxf", write::dxf(&truth, 0.001, 4, Walls::Pieces, [0.0, 0.0]), &options).unwrap();
    // 60 m of building and two margins.
    assert!((seen.width_m() - 65.0).abs() < 0.1, "{}", seen.width_m());
    assert!(seen.classes.contains(&PlanClass::Wall));
}

/// Names that say nothing are listed, and a scenario says what they hold.
#[test]
fn layers_whose_names_say_nothing_are_listed_and_said() {
    let truth = office();
    let meaningless = |mut text: String, names: &[(&str, &str)]| {
        names.iter().for_each(|(name, code)| text = text.replace(name, code));
        text
    };
    let svg = [("Walls", "X-2"), ("\"wall", "\"k2"), (".wall", ".k2"), ("Fenster", "X-4"), ("Türen", "X-3")];
    let svg = meaningless(write::svg(&truth, 100.0), &[&svg[..], &[("\"furniture\"", "\"X-51\"")]].concat());
    let unread = read_with("plan.svg", &svg, &PlanOptions::default()).unwrap();
    let told = unread.warnings.iter().find(|warning| warning.contains("`[plan] layers`"));
    assert!(
        told.is_some_and(|told| ["\"X-2\"", "\"X-3\"", "\"X-51\""].iter().all(|name| told.contains(name))),
        "{told:?}"
    );
    let names = |names: &[&str]| names.iter().map(|name| name.to_string()).collect::<Vec<String>>();
    let layers = PlanLayers {
        wall: names(&["x-2", "k2"]),
        window: names(&["X-4"]),
        door: names(&["X-3"]),
        table: names(&["X-5*"]),
        ..PlanLayers::default()
    };
    let options = PlanOptions { layers: Some(layers), ..PlanOptions::default() };
    let seen = Seen::with("plan.svg", &svg, [2.0, 2.0], &options);
    seen.check(&truth, "SVG whose layers are said");
    assert_eq!((seen.closed_windows(&truth), seen.desks(&truth)), (12, 12));
}

#[test]
fn the_buildings_width_scales_a_drawing() {
    let truth = office();
    let options = PlanOptions { width_m: Some(60.0), ..PlanOptions::default() };
    let seen = read_with("plan.svg", write::svg(&truth, 100.0), &options).unwrap();
    assert_eq!(seen.scale.source, ScaleSource::Width);
    // Twice the size, and two margins.
    assert!((seen.width_m() - 65.0).abs() < 0.1, "{}", seen.width_m());
}

#[test]
fn a_scale_that_doors_tell_is_a_guess() {
    let truth = office();
    let seen = Seen::of("plan.dxf", write::dxf(&truth, 0.01, 0, Walls::Lines, [0.0, 0.0]), [0.0, 0.0]);
    let scale = &seen.plan.scale;
    assert!(scale.source == ScaleSource::Guessed && (0.5..0.95).contains(&scale.sureness), "{scale:?}");
    let [least, most] = scale.range;
    assert!(least < seen.plan.metres_per_pixel && most > seen.plan.metres_per_pixel, "{scale:?}");
    let sure = Seen::of("plan.dxf", write::dxf(&truth, 0.001, 4, Walls::Lines, [0.0, 0.0]), [0.0, 0.0]);
    assert_eq!((sure.plan.scale.source, sure.plan.scale.sureness), (ScaleSource::Drawing, 1.0));
}

/// Half of the people go along the lanes of an Open-RMF building.
#[test]
fn lanes_are_routes() {
    let seen = Seen::of("office.building.yaml", write::rmf(&of_lines()), [4.0, -36.0]);
    let walls = TracedWalls::trace(&seen.plan, &Default::default());
    let found = routes::find(&seen.plan, &walls, &Default::default()).unwrap();
    let along: Vec<_> = found.iter().filter(|route| route.name.starts_with("lane ")).collect();
    assert_eq!(along.iter().map(|route| &route.name[..]).collect::<Vec<_>>(), ["lane 1 to lane 2", "lane 2 to lane 1"]);
    let share: f64 = along.iter().map(|route| route.share).sum();
    assert!((share - 0.5).abs() < 1e-9, "{share}");
    assert!(along.iter().all(|route| (route.length_m - 28.0).abs() < 2.5), "{}", along[0].length_m);
}
