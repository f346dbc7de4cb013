//! Doors and fixtures in a scenario.

use snapbox::{assert_data_eq, str};

use super::*;
use crate::marks::{DoorRequest, FixtureRequest};
use crate::marks::{FixtureAt, FixtureKind};
use crate::plan::DoorAt;

pub(super) fn doors() -> Vec<DoorRequest> {
    let door = DoorRequest {
        name: Some("office".to_string()),
        at: DoorAt::Point(PlanPoint::Metres([1.0, 2.0])),
        width: 1.2,
        height: 2.0,
        hinge: Some(PlanPoint::Pixels { px: [3.0, 4.0] }),
        handle: 1.05,
    };
    vec![door.clone(), DoorRequest { name: None, hinge: None, ..door }]
}

pub(super) fn fixtures() -> Vec<FixtureRequest> {
    let switch = FixtureRequest {
        name: None,
        kind: FixtureKind::Switch,
        at: FixtureAt::Point(PlanPoint::Pixels { px: [3.0, 4.0] }),
        facing: Some(PlanPoint::Metres([1.0, 2.0])),
        width: Some(0.1),
    };
    let ends = [PlanPoint::Metres([1.0, 2.0]), PlanPoint::Metres([3.0, 2.0])];
    let chairs = FixtureRequest {
        name: Some("waiting".to_string()),
        kind: FixtureKind::Chairs,
        at: FixtureAt::Line(ends),
        facing: None,
        width: None,
    };
    vec![switch, chairs]
}

#[test]
fn doors_and_fixtures_read_as_they_are_written() {
    let scenario = parse(&format!(
        "{PLAN}[[door]]\nat = [1, 2]\n[[fixture]]\nkind = \"vending machine\"\nat = {{ px = [3, 4] }}\n"
    ))
    .unwrap_or_else(|error| panic!("{error}"));
    let door = &scenario.doors[0];
    assert_eq!((door.width, door.height, door.handle, door.hinge), (0.9, 2.1, 1.0, None));
    assert_eq!(scenario.fixtures[0].kind, FixtureKind::Machine);
    assert_eq!(scenario.fixtures[0].at, FixtureAt::Point(PlanPoint::Pixels { px: [3.0, 4.0] }));
}

#[test]
fn the_paper_touches_by_distance_alone() {
    let scenario = parse(&format!("{PLAN}[crowd]\npreset = \"paper\"\n[marks.contact]\nreach_m = 0.5\n")).unwrap();
    assert_eq!(scenario.marks.contact.rule, crate::marks::ContactRule::Distance);
    assert_eq!(scenario.marks.contact.reach_m, 0.5);
}

#[test]
fn a_wrong_door_or_fixture_shows_its_place() {
    let with = |text: &str| shown(&format!("{PLAN}{text}"));
    assert_data_eq!(
        with("[[door]]\nat = [1, 2]\nwidth = nan\n"),
        str![[r#"
`width` is NaN, allowed is 0.5 to 6
 --> plans/hall.toml:5:9
  |
5 | width = nan
  |         ^^^

"#]]
    );
    assert_data_eq!(
        with("[[door]]\nat = [1, inf]\n"),
        str![[r#"
`at` is inf, allowed is -10000000 to 10000000
 --> plans/hall.toml:4:6
  |
4 | at = [1, inf]
  |      ^^^^^^^^

"#]]
    );
    assert_data_eq!(
        with("[[door]]\nwidth = 1.0\n"),
        str![[r#"
`at` is missing in [[door]]
 --> plans/hall.toml:3:1
  |
3 | [[door]]
  | ^^^^^^^^

"#]]
    );
    assert_data_eq!(
        with("[[door]]\nat = [1, 2]\nhieght = 2.0\n"),
        str![[r#"
[[door]] has no key `hieght`
 --> plans/hall.toml:5:1
  |
5 | hieght = 2.0
  | ^^^^^^
hint: did you mean `height`?

"#]]
    );
    assert_data_eq!(
        with("[[fixture]]\nkind = \"radiater\"\nat = [1, 2]\n"),
        str![[r#"
`kind` cannot be "radiater"; it is one of switch, handle, counter, bench, radiator, bin, machine, vending machine, chairs
 --> plans/hall.toml:4:8
  |
4 | kind = "radiater"
  |        ^^^^^^^^^^
hint: did you mean "radiator"?

"#]]
    );
    assert_data_eq!(
        with("[[fixture]]\nkind = \"counter\"\nat = [[1, 2], [3, 2]]\nwidth = 2.0\n"),
        str![[r#"
a fixture given by its two ends takes no `width`
 --> plans/hall.toml:6:9
  |
6 | width = 2.0
  |         ^^^

"#]]
    );
    assert_data_eq!(
        with("[[fixture]]\nkind = \"bin\"\nat = 7\n"),
        str![[r#"
`at` takes a point [x, y], or two of them: [[x0, y0], [x1, y1]], not 7
 --> plans/hall.toml:5:6
  |
5 | at = 7
  |      ^

"#]]
    );
}
