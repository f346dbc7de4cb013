//! Stops and timetables in a scenario.

use snapbox::{assert_data_eq, str};

use super::*;
use crate::math::Distribution;
use crate::routes::{StopAt, StopKind, StopRequest, Timetable, TimetableKind};

const ROUTES: &str = "[[route]]\nfrom = \"west\"\nto = \"east\"\n";

pub(super) fn requests() -> Vec<StopRequest> {
    let stop = StopRequest {
        name: "ticket office".to_string(),
        kind: StopKind::Queue,
        at: StopAt::Line([PlanPoint::Metres([1.0, 2.0]), PlanPoint::Metres([3.0, 2.0])]),
        facing: Some(PlanPoint::Pixels { px: [20.0, 30.0] }),
        heading_deg: None,
        dwell: Some(Distribution::normal(30.0, 15.0, 5.0, 120.0)),
        places: Some(2),
        spacing: Some(0.7),
        reach: None,
        queue: vec![PlanPoint::Metres([1.0, 3.0]), PlanPoint::Metres([1.0, 8.0])],
    };
    let bench = StopRequest {
        name: "bench".to_string(),
        kind: StopKind::Bench,
        at: StopAt::Point(PlanPoint::Metres([5.0, 5.0])),
        facing: None,
        heading_deg: Some(-90.0),
        dwell: None,
        reach: Some(2.0),
        queue: Vec::new(),
        ..stop.clone()
    };
    vec![stop, bench]
}

pub(super) fn bursts() -> Timetable {
    Timetable {
        kind: TimetableKind::Bursts,
        every_s: Some(360.0),
        people: Some(120),
        spread_s: Some(45.0),
        ..Timetable::default()
    }
}

pub(super) fn list() -> Timetable {
    Timetable { kind: TimetableKind::List, times: vec![[60.0, 20.0], [300.0, 80.0]], ..Timetable::default() }
}

/// The keys that a key of a timetable cannot be without.
pub(super) fn companions(path: &str) -> &'static str {
    match path.strip_prefix("crowd.arrivals.") {
        Some("every_s") => "kind = \"bursts\"\npeople = 5\n",
        Some("people" | "share") => "kind = \"bursts\"\nevery_s = 60\n",
        Some("spread_s") => "kind = \"bursts\"\nevery_s = 60\npeople = 5\n",
        Some("times") => "kind = \"list\"\n",
        _ => "",
    }
}

#[test]
fn a_stop_reads_as_it_is_written() {
    let scenario = parse(&format!(
        "{PLAN}{ROUTES}via = [\"ticket office\", {{ stop = \"board\", share = 0.2 }}, [1, 2]]\n\
         [[stop]]\nname = \"ticket office\"\nkind = \"queue\"\nat = [3, 4]\n\
         dwell = {{ mean = 30, sd = 15, min = 5, max = 120 }}\nplaces = 2\n\
         [[stop]]\nname = \"board\"\nat = [[1, 2], [3, 4]]\nfacing = {{ px = [3, 4] }}\n"
    ));
    let scenario = scenario.unwrap_or_else(|error| panic!("{error}"));
    let [office, board] = scenario.routes.stops.as_slice() else { panic!("{:?}", scenario.routes.stops) };
    assert_eq!((office.kind, office.places), (StopKind::Queue, Some(2)));
    assert_eq!(office.dwell, Some(Distribution::normal(30.0, 15.0, 5.0, 120.0)));
    assert_eq!(board.at, StopAt::Line([PlanPoint::Metres([1.0, 2.0]), PlanPoint::Metres([3.0, 4.0])]));
    assert_eq!(board.kind, StopKind::Place);
    let via = &scenario.routes.routes[0].via;
    let stopped: Vec<_> = via.iter().map(|via| via.stop(&scenario.routes.stops)).collect();
    assert_eq!(stopped, [Some(("ticket office", 1.0)), Some(("board", 0.2)), None]);
    // Only what is passed or begun at is floor for sure.
    assert_eq!(scenario.plan_options().floor, [PlanPoint::Metres([1.0, 2.0])]);
}

#[test]
fn lists_say_how_many_people_walk_unless_the_file_does() {
    let own = "arrivals = { kind = \"list\", times = [[60, 20], [300, 80]] }\n";
    let people = |text: String| parse(&text).unwrap_or_else(|error| panic!("{error}")).crowd.people;
    assert_eq!(people(format!("{PLAN}{ROUTES}{own}{ROUTES}{own}")), 200);
    assert_eq!(people(format!("{PLAN}{ROUTES}{own}{ROUTES}")), 1000);
    assert_eq!(people(format!("{PLAN}[crowd]\npeople = 7\n{ROUTES}{own}")), 7);
    assert_eq!(people(format!("{PLAN}[crowd.arrivals]\nkind = \"list\"\ntimes = [[0, 3], [9, 2]]\n")), 5);
    assert_eq!(people(PLAN.to_string()), 1000);
}

#[test]
fn timetables_are_read_from_files_beside_the_scenario() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("hall.toml");
    let text = format!("{PLAN}[crowd.arrivals]\nkind = \"list\"\nfile = \"day.csv\"\n");
    std::fs::write(dir.path().join("day.csv"), "time,people\n60,20\n300,80\n").unwrap();
    let scenario = Scenario::parse(&text, &path, &Overrides::default()).unwrap();
    assert_eq!(scenario.crowd.people, 100);
    assert_eq!(scenario.crowd.arrivals.rows().collect::<Vec<_>>(), [[60.0, 20.0], [300.0, 80.0]]);
    let again = Scenario::parse(&scenario.to_toml(), &path, &Overrides::default()).unwrap();
    assert_eq!(again, scenario);
    std::fs::write(dir.path().join("day.csv"), "time,people\n60,many\n").unwrap();
    let error = Scenario::parse(&text, &path, &Overrides::default()).unwrap_err();
    let shown = error.to_string();
    assert!(shown.contains("day.csv, line 2: it is no time and number of people"), "{shown}");
    assert!(shown.contains("hall.toml:5:8"), "{shown}");
    std::fs::write(dir.path().join("day.csv"), "# nothing\n").unwrap();
    let shown = Scenario::parse(&text, &path, &Overrides::default()).unwrap_err().to_string();
    assert!(shown.contains("has no line with a time"), "{shown}");
    std::fs::write(dir.path().join("day.csv"), "\n").unwrap();
    let shown = Scenario::parse(&text, &path, &Overrides::default()).unwrap_err().to_string();
    assert!(shown.contains("is empty"), "{shown}");
}

#[test]
fn a_wrong_stop_shows_its_place() {
    let stop = "[[stop]]\nname = \"bench\"\nat = [1, 2]\n";
    let with = |via: &str, stop: &str| shown(&format!("{PLAN}{ROUTES}via = {via}\n{stop}"));
    assert_data_eq!(
        with("[{ stop = \"bank\", share = 0.2 }]", stop),
        str![[r#"
there is no stop called "bank"
 --> plans/hall.toml:6:8
  |
6 | via = [{ stop = "bank", share = 0.2 }]
  |        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
hint: the stops are "bench"

"#]]
    );
    assert_data_eq!(
        with("[[1, 2], \"bensh\"]", stop),
        str![[r#"
there is no stop called "bensh"
 --> plans/hall.toml:6:16
  |
6 | via = [[1, 2], "bensh"]
  |                ^^^^^^^
hint: did you mean "bench"?

"#]]
    );
    assert_data_eq!(
        with("[{ stop = \"bench\", share = 1.5 }]", stop),
        str![[r#"
`share` is 1.5, allowed is 0 to 1
 --> plans/hall.toml:6:34
  |
6 | via = [{ stop = "bench", share = 1.5 }]
  |                                  ^^^

"#]]
    );
    assert_data_eq!(
        with("[3]", stop),
        str![[r#"
`via` takes an opening's or a stop's name, a point [x, y], an area [[x0, y0], [x1, y1]], or { stop = "name", share = 0.2 }, not 3
 --> plans/hall.toml:6:8
  |
6 | via = [3]
  |        ^

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}places = 0\nkind = \"queue\"\n")),
        str![[r#"
`places` is 0, allowed is 1 to 1000
  --> plans/hall.toml:10:10
   |
10 | places = 0
   |          ^

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}dwell = nan\n")),
        str![[r#"
`dwell`: it is NaN, allowed is 0 to 86400
  --> plans/hall.toml:10:9
   |
10 | dwell = nan
   |         ^^^
hint: write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}dwell = {{ mean = 5, sd = 9, min = -2 }}\n")),
        str![[r#"
`dwell`: it can be as small as -2, allowed is 0 to 86400
  --> plans/hall.toml:10:9
   |
10 | dwell = { mean = 5, sd = 9, min = -2 }
   |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
hint: write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}kind = \"que\"\n")),
        str![[r#"
`kind` cannot be "que"; it is one of place, queue, machine, bench, gate
  --> plans/hall.toml:10:8
   |
10 | kind = "que"
   |        ^^^^^

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}{stop}")),
        str![[r#"
there are two stops called "bench"
  --> plans/hall.toml:11:8
   |
11 | name = "bench"
   |        ^^^^^^^
hint: give each [[stop]] a name of its own

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", "[[stop]]\nname = \"bench\"\n"),
        str![[r#"
`at` is missing in [[stop]]
 --> plans/hall.toml:7:1
  |
7 | [[stop]]
  | ^^^^^^^^

"#]]
    );
    assert_data_eq!(
        with("[\"bench\"]", &format!("{stop}seats = 3\n")),
        str![[r#"
[[stop]] has no key `seats`
  --> plans/hall.toml:10:1
   |
10 | seats = 3
   | ^^^^^
hint: its keys are name, kind, at, facing, heading_deg, dwell, places, spacing, reach, queue

"#]]
    );
    assert_data_eq!(
        with("[]", "[stop]\nname = \"bench\"\n"),
        str![[r#"
`stop` is a list of sections
 --> plans/hall.toml:7:2
  |
7 | [stop]
  |  ^^^^
hint: write [[stop]] with two brackets, once per stop

"#]]
    );
}

#[test]
fn a_wrong_timetable_shows_its_place() {
    assert_data_eq!(
        shown(&format!("{PLAN}[crowd.arrivals]\nkind = \"bursts\"\nevery_s = 60\n")),
        str![[r#"
bursts need either `people` or `share`: how many come in one
 --> plans/hall.toml:4:8
  |
4 | kind = "bursts"
  |        ^^^^^^^^

"#]]
    );
    assert_data_eq!(
        shown(&format!("{PLAN}[crowd.arrivals]\nevery_s = 60\n")),
        str![[r#"
`every_s` does not go with the kind "rate"
 --> plans/hall.toml:4:11
  |
4 | every_s = 60
  |           ^^

"#]]
    );
    assert_data_eq!(
        shown(&format!("{PLAN}{ROUTES}arrivals = {{ kind = \"list\", times = [[-5, 3]] }}\n")),
        str![[r#"
the time -5 is not within 0 to 10000000 seconds
 --> plans/hall.toml:6:37
  |
6 | arrivals = { kind = "list", times = [[-5, 3]] }
  |                                     ^^^^^^^^^

"#]]
    );
    assert_data_eq!(
        shown(&format!("{PLAN}{ROUTES}arrivals = {{ kind = \"list\", file = \"nowhere.csv\" }}\n")),
        str![[r#"
cannot read the timetable plans/nowhere.csv: No such file or directory (os error 2)
 --> plans/hall.toml:6:36
  |
6 | arrivals = { kind = "list", file = "nowhere.csv" }
  |                                    ^^^^^^^^^^^^^

"#]]
    );
}
