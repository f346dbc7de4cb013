use std::path::Path;

use super::*;
use crate::look::Look;
use crate::plan::PlanPoint;
use crate::routes::{PlaceRequest, RouteRequest, ViaRequest};

mod formations;
mod keys;
mod mistakes;
mod places;
mod stops;

const PLAN: &str = "[plan]\nimage = \"plan.png\"\n";

fn parse(text: &str) -> Result<Scenario, ScenarioError> {
    Scenario::parse(text, Path::new("plans/hall.toml"), &Overrides::default())
}

/// What the user reads: the message, the place, the hint.
fn shown(text: &str) -> String {
    let error = parse(text).unwrap_err();
    match error.hint() {
        Some(hint) => format!("{error}\nhint: {hint}\n"),
        None => format!("{error}\n"),
    }
}

#[test]
fn a_plan_alone_is_a_scenario() {
    let from_image = Scenario::from_plan(Path::new("plans/plan.png"), &Overrides::default()).unwrap();
    assert_eq!(from_image, parse(PLAN).unwrap());
    assert_eq!(from_image.plan_path().unwrap(), Path::new("plans/plan.png"));
}

#[test]
fn paths_start_from_the_files_folder() {
    let scenario =
        parse("[plan]\nimage = \"img/a.png\"\n[patterns]\nfolder = \"../soles\"\n[look.floor]\nimage = \"oak.png\"\n");
    let scenario = scenario.unwrap();
    assert_eq!(scenario.plan_path().unwrap(), Path::new("plans/img/a.png"));
    assert_eq!(scenario.pattern_path().unwrap(), Path::new("plans/../soles"));
    assert_eq!(scenario.look.floor.image.unwrap(), Path::new("plans/oak.png"));
}

#[test]
fn a_preset_changes_the_defaults_and_written_keys_win() {
    let text = format!("{PLAN}[crowd]\npreset = \"paper\"\n[look.film]\nper_pass = 0.5\n");
    let scenario = parse(&text).unwrap();
    let paper = Scenario::of_preset(Preset::Paper);
    assert_eq!(scenario.preset, Preset::Paper);
    assert_eq!(scenario.crowd, crate::crowd::CrowdOptions::paper());
    assert_eq!(scenario.bodies, paper.bodies);
    assert_eq!(scenario.marks, paper.marks);
    assert_eq!(scenario.look.film.per_pass, 0.5);
    assert_eq!(scenario.look.prints, paper.look.prints);

    let text = format!(
        "{PLAN}[crowd]\npreset = \"paper\"\n[bodies]\nbags = 0.1\nstep_length = 0.7\n[look]\npreset = \"heavy\"\n"
    );
    let scenario = parse(&text).unwrap();
    assert_eq!(scenario.bodies.bags, 0.1);
    assert_eq!(scenario.bodies.step_length, Some(crate::math::Distribution::Constant(0.7)));
    assert_eq!(scenario.look, Look::preset("heavy").unwrap());
}

#[test]
fn overrides_win_over_the_file() {
    let text = "[plan]\nimage = \"plan.png\"\nscale = { from = { px = [0, 0] }, to = { px = [9, 0] }, metres = 3 }\n\
                [crowd]\nseed = 5\n[texture]\nfloor_texels_per_metre = 50\n[look]\npreset = \"wet\"\n";
    let overrides = Overrides {
        preset: Some(Preset::Heavy),
        seed: Some(7),
        texels_per_metre: Some(25.0),
        metres_per_pixel: Some(0.1),
        ..Overrides::default()
    };
    let scenario = Scenario::parse(text, Path::new("a.toml"), &overrides).unwrap();
    assert_eq!(scenario.seed, 7);
    assert_eq!(scenario.floor_texels_per_metre, 25.0);
    assert_eq!((scenario.plan.metres_per_pixel, scenario.plan.scale), (Some(0.1), None));
    assert_eq!(scenario.look, Look::preset("heavy").unwrap());
}

#[test]
fn what_is_written_reads_back_the_same() {
    for preset in Preset::ALL {
        let mut scenario = Scenario::of_preset(preset);
        scenario.image = Some("plan.png".into());
        scenario.folder = "plans".into();
        scenario.routes.routes = routes();
        scenario.routes.stops = stops::requests();
        scenario.crowd.arrivals = stops::bursts();
        scenario.doors = places::doors();
        scenario.fixtures = places::fixtures();
        let text = scenario.to_toml();
        assert_eq!(parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}")), scenario, "{text}");
    }
}

#[test]
fn settings_name_files_but_not_where_they_lie() {
    let text = "[plan]\nimage = \"/home/me/a.png\"\n[patterns]\nfolder = \"/home/me/soles\"\n[look.floor]\nimage = \"oak.png\"\n";
    let settings = Scenario::parse(text, Path::new("/home/me/a.toml"), &Overrides::default()).unwrap().settings();
    assert_eq!(settings["plan"]["image"], "a.png");
    assert_eq!(settings["crowd"]["people"], 1000);
    assert!(!settings.to_string().contains("/home"), "{settings}");
}

fn routes() -> Vec<RouteRequest> {
    let opening = |name: &str| PlaceRequest::Opening(name.to_string());
    let area = PlaceRequest::Area([[1.0, 2.0], [3.0, 4.5]]);
    let via = vec![
        PlaceRequest::Point(PlanPoint::Metres([5.0, 6.0])).into(),
        PlaceRequest::Point(PlanPoint::Pixels { px: [7.0, 8.0] }).into(),
        opening("ticket office").into(),
        ViaRequest::Stop(crate::routes::SharedStop { stop: "bench".to_string(), share: 0.2 }),
    ];
    let first = RouteRequest {
        name: None,
        from: opening("west"),
        to: opening("north 2"),
        via: Vec::new(),
        share: 1.0,
        arrivals: Some(stops::list()),
    };
    let name = Some("round".to_string());
    vec![first, RouteRequest { name, from: area, to: opening("south"), via, share: 0.25, arrivals: None }]
}

mod any_text {
    use proptest::prelude::*;

    proptest! {
        /// Whatever stands in a file, reading it ends with a scenario or an error that names a place in the file.
        #[test]
        fn never_panics(text in "[ -~\n\t\u{e9}]{0,200}") {
            let _ = super::parse(&text).map_err(|error| error.to_string());
        }

        #[test]
        fn never_panics_on_damaged_scenarios(at in 0usize..4000, with in "[ -~\n]{0,3}", length in 0usize..20) {
            let mut scenario = super::Scenario::of_preset(super::Preset::Commuters);
            scenario.image = Some("plan.png".into());
            let mut text = scenario.to_toml();
            let start = at.min(text.len());
            let end = (start + length).min(text.len());
            text.replace_range(start..end, &with);
            if let Err(error) = super::parse(&text) {
                prop_assert!(error.to_string().lines().count() <= 6, "{error}");
            }
        }
    }
}

#[test]
fn a_first_look_is_coarse_and_has_few_people_unless_a_scenario_says_how_many() {
    let quick = Overrides { quick: true, ..Overrides::default() };
    let of = |text: &str| Scenario::parse(text, Path::new("plans/hall.toml"), &quick).unwrap();
    let first = of(PLAN);
    assert_eq!((first.floor_texels_per_metre, first.wall_texels_per_metre), (25.0, 25.0));
    assert_eq!((first.crowd.people, first.routes.life.people, first.texture.layers), (400, 400, Some(false)));
    assert_eq!(of(&format!("{PLAN}[crowd]\npeople = 1500\n")).crowd.people, 1500);
    // The default counts as well, where it is written.
    assert_eq!(of(&format!("{PLAN}[crowd]\npeople = 1000\n")).crowd.people, 1000);
    let said = Scenario::parse(PLAN, Path::new("plans/hall.toml"), &Overrides { people: Some(30), ..quick }).unwrap();
    assert_eq!(said.crowd.people, 30);
}
