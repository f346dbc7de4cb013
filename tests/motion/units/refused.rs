use std::fs;
use std::path::Path;

use trodden::crowd::{CrowdError, CrowdModel, SpotRequest};
use trodden::plan::PlanPoint;
use trodden::scenario::{Overrides, Scenario};
use trodden::units::UnitLibrary;

use super::scene::Scene;

fn refused(spot: SpotRequest) -> CrowdError {
    let scene = Scene::plaza();
    scene.begin(spot).err().expect("the spot is refused")
}

#[test]
fn a_spot_in_a_wall_is_an_error_with_its_place_and_the_nearest_floor() {
    let at = |x: f64, y: f64| SpotRequest::new(PlanPoint::Metres([x, y]), 90.0);
    let error = refused(SpotRequest { name: Some("basin".into()), ..at(24.2, 13.3) });
    assert_eq!(error.to_string(), "crowd: basin at [24.20, 13.30] lies in a wall or off the floor");
    assert!(error.hint().unwrap().starts_with("the nearest floor to stand on is at [2"), "{error:?}");
    let error = refused(at(1.6, 5.0));
    assert_eq!(error.to_string(), "crowd: spot 1 at [1.60, 5.00] is 0.10 m from a wall, needed are at least 0.2 m");
    let error = refused(at(900.0, 5.0));
    assert!(error.hint().unwrap().contains("no floor"), "{error:?}");
    let error = refused(at(f64::NAN, 5.0));
    assert!(error.to_string().contains("off the floor"), "{error}");
    let itself = SpotRequest { heading_deg: None, facing: Some(PlanPoint::Metres([14.0, 8.5])), ..at(14.0, 8.5) };
    assert!(refused(itself).to_string().contains("looks at its own place"));
    assert!(refused(SpotRequest { every: 0.0, ..at(14.0, 8.5) }).to_string().contains("`every` is 0"));
}

#[test]
fn units_that_match_nobody_are_never_played_and_a_warning_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let six = UnitLibrary::built_in_files().iter().find(|(name, _)| *name == "two_pairs_passed.toml").unwrap();
    fs::write(folder.path().join(six.0), six.1).unwrap();
    let scene = Scene::plaza();
    let spot = SpotRequest { folder: Some(folder.path().to_path_buf()), ..scene.spot() };
    let (moments, report) = scene.run(spot, 12.0);
    assert!(moments.iter().flatten().all(|seen| !seen.led));
    assert_eq!((report.splices, report.fitting), (0, [1, 1]));
    assert!(report.unmatched > 0 && report.unmatched == report.moments);
    let warning = report.warning().unwrap();
    assert!(warning.contains("no unit was played in") && warning.contains("without a unit: "), "{warning}");
}

#[test]
fn no_unit_is_played_through_a_wall() {
    // Half a metre before the wall, looking at it: whatever happens in front happens in the wall.
    let scene = Scene::plaza();
    let spot = SpotRequest::new(PlanPoint::Metres([16.0, 2.0]), -90.0);
    let spot = SpotRequest { at: PlanPoint::Metres([22.0, 2.0]), ..spot };
    let (moments, report) = scene.run(spot, 3.0);
    assert!(report.fitting[0] < 6 && report.fitting[1] > 60, "{:?}", report.fitting);
    assert!(moments.iter().flatten().all(|seen| scene.walls.is_inside(seen.place_m)));
}

#[test]
fn broken_units_are_named_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let of = |folder: &Path| {
        let scene = Scene::plaza();
        refused(SpotRequest { folder: Some(folder.to_path_buf()), ..scene.spot() })
    };
    let error = of(folder.path());
    assert!(error.to_string().contains("there is no unit") && error.hint().is_some(), "{error}");
    fs::write(
        folder.path().join("bad.toml"),
        "name = \"a\"\narea = [3.0, 4.0]\nduration = 4.0\n[[member]]\npath = [[0.0, 1.0]]\n",
    )
    .unwrap();
    let error = of(folder.path());
    assert!(error.to_string().contains("bad.toml:5:9: a row of a path is [t, x, y, heading], not 2"), "{error}");
    let error = of(&folder.path().join("none"));
    assert!(error.to_string().contains("cannot read"), "{error}");
}

fn scenario(text: &str) -> Result<Scenario, String> {
    let text = format!("[plan]\nimage = \"plan.png\"\n{text}");
    Scenario::parse(&text, Path::new("a.toml"), &Overrides::default()).map_err(|error| {
        let error = trodden::Error::from(error);
        format!("{error}\n{}", error.hint().unwrap_or_default())
    })
}

#[test]
fn units_need_the_model_whose_people_walk_in_groups() {
    const UNIT: &str = "[[unit]]\nat = [14.0, 8.5]\nheading_deg = 90\n";
    assert_eq!(scenario(UNIT).unwrap().crowd.model, CrowdModel::SocialForce);
    assert_eq!(scenario("").unwrap().crowd.model, CrowdModel::Boids);
    let error = scenario(&format!("[crowd]\nmodel = \"boids\"\n{UNIT}")).unwrap_err();
    assert!(error.contains("needs the social force model") && error.contains("a.toml:4:9"), "{error}");
}

#[test]
fn a_scenarios_spots_are_checked_written_and_read_again() {
    let wrong = |keys: &str| scenario(&format!("[[unit]]\nat = [14.0, 8.5]\n{keys}\n")).unwrap_err();
    for (keys, expected) in [
        ("", "the direction in which the viewer looks is missing"),
        ("heading_deg = 90\nfacing = [1, 2]", "both `facing` and `heading_deg`"),
        ("heading_deg = 90\nevery = 0", "`every` is 0, allowed is 0.05 to 60"),
        ("heading_deg = 90\npause = nan", "`pause` is"),
        ("heading_deg = 90\narea = [3.0, 700.0]", "`area` is 700, allowed is 1 to 40"),
        ("heading_deg = 90\nradios = 0.3", "did you mean `radius`?"),
        ("heading_deg = 90\nfolder = 3", "`folder` takes"),
    ] {
        let error = wrong(keys);
        assert!(error.contains(expected) && error.contains("a.toml:"), "{keys}: {error}");
    }
    let good = "[[unit]]\nname = \"kiosk\"\nat = [14.0, 8.5]\nfacing = [14.0, 9.5]\nfolder = \"mine\"\nfront = [2.0, 4.0]\nplay = false\n";
    let read = scenario(good).unwrap();
    assert_eq!((read.units[0].front, read.units[0].play, read.units[0].pause), ([2.0, 4.0], false, 1.0));
    assert!(read.spots()[0].folder.as_ref().unwrap().ends_with("mine"));
    let again = Scenario::parse(&read.to_toml(), Path::new("a.toml"), &Overrides::default()).unwrap();
    assert_eq!(again.units, read.units);
}
