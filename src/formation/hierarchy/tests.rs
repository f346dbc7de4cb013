use std::path::{Path, PathBuf};

use image::{GrayImage, Luma};
use proptest::prelude::*;

use super::super::request::*;
use super::*;
use crate::Silent;
use crate::formation::formed::FormedCrowd;
use crate::math::{Vec2, vec2};

fn request(text: &str) -> FormationRequest {
    crate::options::parse(text).unwrap_or_else(|mistake| panic!("{}\n{text}", mistake.explain(text).0))
}

fn formed(text: &str) -> FormedCrowd {
    form(&request(text), Path::new(""), &Silent).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refused(text: &str, folder: &Path) -> String {
    let error = form(&request(text), folder, &Silent).unwrap_err();
    format!("{error}; {}", error.hint().unwrap_or_default())
}

/// The distance between two sets of places, whoever stands where.
fn apart_m(places: &[Vec2], others: &[Vec2]) -> f64 {
    assert_eq!(places.len(), others.len());
    let nearest = |place: &Vec2| others.iter().map(|other| other.distance(*place)).fold(f64::MAX, f64::min);
    places.iter().map(nearest).fold(0.0, f64::max)
}

fn centroid(places: &[Vec2]) -> Vec2 {
    places.iter().fold(Vec2::ZERO, |sum, &place| sum + place) / places.len() as f64
}

const OFF: &str = "avoid = { on = false }\n";

#[test]
fn key_formations_are_taken_up_at_their_times() {
    let text = format!(
        "{OFF}example = {{ kind = \"ranks\", rows = 3, columns = 3 }}\n\
         [[key]]\ntime_s = 0\nshape = \"triangle\"\nfilled = false\nspacing_m = 1.0\n\
         [[key]]\ntime_s = 10\nshape = \"ring\"\nradius_m = 3.0\nat = [5.0, 2.0]\n\
         [[key]]\ntime_s = 20\nhold_s = 2\nshape = \"grid\"\ncolumns = 3\nat = [9.0, 0.0]\nturn_deg = 90\nscale = 2\n"
    );
    let formed = formed(&text);
    assert_eq!((formed.ensemble.people(), formed.ensemble.moments(), formed.ensemble.fps), (9, 221, 10.0));
    let at = |moment: usize| formed.ensemble.places_at(moment);
    assert!(at(100).iter().all(|place| (place.distance(vec2(5.0, 2.0)) - 3.0).abs() < 1e-6), "{:?}", at(100));
    let block: Vec<Vec2> = (0..9).map(|k| vec2(7.0 + 2.0 * f64::from(k % 3), -2.0 + 2.0 * f64::from(k / 3))).collect();
    for moment in [200, 220] {
        assert!(apart_m(&block, at(moment)) < 1e-6, "{:?}", at(moment));
    }
    // While a formation is held, the example's motion goes on.
    assert!(apart_m(at(210), at(200)) > 0.01);
    // Nobody goes farther than they must: the way along all three is below that by order.
    let way = |formed: &FormedCrowd| -> f64 {
        let places = [0, 100, 200].map(|moment| formed.ensemble.places_at(moment).to_vec());
        let leg = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| a.distance(*b)).sum::<f64>();
        leg(&places[0], &places[1]) + leg(&places[1], &places[2])
    };
    assert!(way(&formed) < way(&super::tests::formed(&format!("assign = \"order\"\n{text}"))));
}

#[test]
fn the_examples_own_formation_stands_where_nothing_is_said() {
    let ranks = "example = { kind = \"ranks\", rows = 3, columns = 3 }\nduration_s = 10\n";
    let plain = formed(&format!("{OFF}{ranks}"));
    let led = formed(&format!("{OFF}{ranks}[[key]]\ntime_s = 0\nshape = \"ring\"\n"));
    assert!(apart_m(plain.ensemble.places_at(100), led.ensemble.places_at(100)) < 1e-6);
    assert!(apart_m(plain.ensemble.places_at(0), led.ensemble.places_at(0)) > 0.3);
    // Who stands has no formation of their own: they stay in what was asked for.
    let still =
        formed(&format!("{OFF}duration_s = 4\nexample = {{ people = 5 }}\n[[key]]\ntime_s = 1\nshape = \"ring\"\n"));
    assert!(apart_m(still.ensemble.places_at(0), still.ensemble.places_at(40)) < 1e-9);
    assert!(
        still
            .ensemble
            .places_at(0)
            .iter()
            .all(|p| (p.length() - 0.5 / crate::math::sin_cos(0.628_318_53).0).abs() < 1e-6)
    );
}

#[test]
fn a_formation_wheels_as_one_body() {
    // By exactly half a turn, and by more than a whole one.
    for degrees in [180.0, 450.0] {
        let text = format!(
            "{OFF}example = {{ people = 6 }}\n[[key]]\ntime_s = 0\nshape = \"triangle\"\nat = [2, 1]\n\
             [[key]]\ntime_s = 10\nshape = \"triangle\"\nat = [2, 1]\nturn_deg = {degrees}\nwheel_deg = {degrees}\n"
        );
        let formed = formed(&text);
        let start = formed.ensemble.places_at(0).to_vec();
        let middle = centroid(&start);
        for moment in 0..=100 {
            let here = formed.ensemble.places_at(moment);
            assert!(centroid(here).distance(middle) < 1e-6);
            for (place, before) in here.iter().zip(&start) {
                let (now_m, then_m) = (place.distance(middle), before.distance(middle));
                assert!((now_m - then_m).abs() < 1e-3, "{moment}: {now_m} m from the middle, not {then_m}");
            }
        }
    }
    // Without wheeling, people change places by the shortest way, and nobody is lost in the middle.
    let text = "example = { people = 6 }\n[[key]]\ntime_s = 0\nshape = \"triangle\"\n\
                [[key]]\ntime_s = 10\nshape = \"triangle\"\nturn_deg = 180\n";
    let formed = formed(text);
    let turned: Vec<Vec2> = formed.ensemble.places_at(0).iter().map(|&place| -place).collect();
    assert!(apart_m(&turned, formed.ensemble.places_at(100)) < 0.05);
}

/// Three armies of two groups of three people with a rider: F7 at three levels.
const NESTED: &str = r#"
duration_s = 6
[[key]]
time_s = 0
points = [[0, 0], [20, 0], [40, 0]]
[[key]]
time_s = 6
points = [[0, 6], [20, 6], [40, 6]]
[[crowd]]
members = [0, 2]
[[crowd.key]]
time_s = 0
points = [[-4, 0], [4, 0]]
[[crowd.crowd]]
members = [1]
rider = true
follow_heading = true
example = { kind = "sway", people = 3 }
[[crowd.crowd.key]]
time_s = 0
shape = "triangle"
spacing_m = 0.7
"#;

#[test]
fn small_crowds_stand_in_the_places_of_individuals_at_any_depth() {
    let formed = formed(NESTED);
    let addresses: Vec<&[u32]> = formed.people.iter().map(|who| who.address.as_slice()).collect();
    let army = |k: u32| vec![vec![k, 0], vec![k, 1, 0], vec![k, 1, 1], vec![k, 1, 2], vec![k, 1, 3]];
    let expected: Vec<Vec<u32>> = [army(0), vec![vec![1]], army(2)].concat();
    assert_eq!(addresses, expected);
    assert_eq!(formed.ensemble.ids, (0..11).collect::<Vec<u32>>());
    assert_eq!(formed.people.iter().map(|who| who.rides).filter(|&rides| rides).count(), 2);
    assert!(formed.people[4].rides && formed.people[10].rides);
    for moment in 0..=60 {
        let here = formed.ensemble.places_at(moment);
        let y = 6.0 * crate::math::smoothstep(f64::from(moment as u32) / 60.0);
        assert!(here[0].distance(vec2(-4.0, y)) < 0.02, "{moment}: {:?}", here[0]);
        assert!(here[5].distance(vec2(20.0, y)) < 0.02, "{moment}: {:?} for {y}", here[5]);
        // The rider is in the middle of the three, and they where the individual would be.
        let carriers = centroid(&here[1..4]);
        assert!(carriers.distance(here[4]) < 1e-6 && carriers.distance(vec2(4.0, y)) < 0.02, "{moment}: {carriers:?}");
    }
    let on_foot = formed.on_foot();
    assert_eq!(on_foot.ids, [0, 1, 2, 3, 5, 6, 7, 8, 9]);
    assert_eq!(on_foot.moments(), 61);
    assert_eq!(on_foot.places_at(30)[4], formed.ensemble.places_at(30)[5]);
    // They head up the picture, where they go: the tip of the triangle is in front.
    let here = formed.ensemble.places_at(30);
    assert!(here[1].y > here[2].y + 0.3 && here[1].y > here[3].y + 0.3, "{here:?}");
}

#[test]
fn ids_stay_whatever_else_changes() {
    let more = format!("{NESTED}[[crowd.crowd.key]]\ntime_s = 3\nshape = \"ring\"\n");
    assert_eq!(formed(NESTED).people, formed(&more).people);
}

#[test]
fn every_small_crowd_of_a_kind_has_people_of_its_own() {
    let text = |choose: &str| {
        format!(
            "duration_s = 3\nexample = {{ people = 3 }}\n[[key]]\ntime_s = 0\nshape = \"line\"\nspacing_m = 9\n[[crowd]]\n\
             example = {{ kind = \"ranks\", rows = 3, columns = 3, choose = {choose} }}\n"
        )
    };
    let formed = formed(&text("[[0, 1, 3], [4, 5, 7]]"));
    let shape = |crowd: usize| {
        let places = &formed.ensemble.places_at(0)[3 * crowd..3 * crowd + 3];
        places.iter().map(|&place| place - centroid(places)).collect::<Vec<_>>()
    };
    // The third takes the first list again, with an example of its own.
    assert!(apart_m(&shape(0), &shape(2)) < 0.6);
    assert_ne!(shape(0), shape(2));
    let message = refused(&text("[[0, 9]]"), Path::new(""));
    assert!(message.contains("formation.crowd.0.example.choose") && message.contains("person 9"), "{message}");
}

fn pictures() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let dot = |x: u32, y: u32| if (x % 20).abs_diff(10) < 3 && (y % 20).abs_diff(10) < 3 { 0 } else { 255 };
    GrayImage::from_fn(80, 60, |x, y| Luma([dot(x, y)])).save(folder.path().join("dots.png")).unwrap();
    let inside = |x: u32, y: u32| if (20..60).contains(&x) && (10..50).contains(&y) { 255 } else { 0 };
    GrayImage::from_fn(80, 60, |x, y| Luma([inside(x, y)])).save(folder.path().join("square.png")).unwrap();
    std::fs::write(folder.path().join("three.txt"), "# x y\n0 0\n1.5, 0\n3 4\n").unwrap();
    folder
}

#[test]
fn dots_shapes_and_points_in_files_come_back_as_places() {
    let folder = pictures();
    let with = |key: &str, people: &str| {
        let text = format!("{OFF}{people}\nduration_s = 1\n[[key]]\ntime_s = 0\n{key}\n");
        form(&request(&text), folder.path(), &Silent).unwrap_or_else(|error| panic!("{error}"))
    };
    // As many people as dots, where nothing else is said.
    let dots = with("file = \"dots.png\"\nmetres_per_pixel = 0.05", "");
    let expected: Vec<Vec2> = (0..12).map(|k| vec2(f64::from(k % 4) - 1.5, 1.0 - f64::from(k / 4))).collect();
    // A dot of five pixels has its middle half a pixel beside the square's.
    assert!(apart_m(&expected, dots.ensemble.places_at(0)) < 0.05, "{:?}", dots.ensemble.places_at(0));
    let square = with("file = \"square.png\"\nfilled = true", "example = { people = 16 }");
    let places = square.ensemble.places_at(0);
    assert!(places.len() == 16 && places.iter().all(|place| place.x.abs() <= 2.0 && place.y.abs() <= 2.0));
    for (k, place) in places.iter().enumerate() {
        assert!(places[..k].iter().all(|other| other.distance(*place) > 0.6), "{places:?}");
    }
    let three = with("file = \"three.txt\"", "");
    assert!(apart_m(&[vec2(0.0, 0.0), vec2(1.5, 0.0), vec2(3.0, 4.0)], three.ensemble.places_at(0)) < 1e-9);
}

#[test]
fn other_counts_are_refused_with_both_numbers() {
    let folder = pictures();
    let with = |people: u32, key: &str| {
        let text = format!("example = {{ people = {people} }}\nduration_s = 1\n[[key]]\ntime_s = 0\n{key}\n");
        refused(&text, folder.path())
    };
    let message = with(14, "file = \"dots.png\"");
    assert!(message.contains("14 people, but 12 dots in dots.png") && message.contains("filled"), "{message}");
    let message = with(9, "file = \"dots.png\"");
    assert!(message.contains("9 people, but 12 dots"), "{message}");
    let message = with(2, "points = [[0, 0], [1, 0], [2, 0]]");
    assert!(message.contains("formation.key.0") && message.contains("2 people, but 3 points"), "{message}");
    assert!(with(2, "file = \"none.txt\"").contains("none.txt"));
    let message = refused("[[key]]\ntime_s = 0\nshape = \"ring\"\n", Path::new(""));
    assert!(message.contains("the number of people is missing"), "{message}");
}

#[test]
fn nobody_overlaps_and_nobody_jumps() {
    let keys = "[[key]]\ntime_s = 0\nshape = \"grid\"\ncolumns = 6\nspacing_m = 0.8\n\
                [[key]]\ntime_s = 12\nassign = \"order\"\nshape = \"star\"\nradius_m = 3.5\n\
                [[key]]\ntime_s = 24\nhold_s = 2\nassign = \"order\"\nshape = \"grid\"\ncolumns = 4\nspacing_m = 0.9\nturn_deg = 60\n";
    let text = format!("example = {{ kind = \"sway\", people = 24 }}\n{keys}");
    let (clear, through) = (formed(&text), formed(&format!("{OFF}{text}")));
    let nearest_m = |formed: &FormedCrowd| {
        let moments = 0..formed.ensemble.moments();
        let at = moments.flat_map(|moment| {
            let here = formed.ensemble.places_at(moment);
            (0..here.len()).flat_map(move |a| (0..a).map(move |b| here[a].distance(here[b])))
        });
        at.fold(f64::MAX, f64::min)
    };
    assert!(nearest_m(&through) < 0.2, "{} m", nearest_m(&through));
    assert!(nearest_m(&clear) >= 0.36 - 1e-9, "{} m", nearest_m(&clear));
    let hardest_m_s2 = |formed: &FormedCrowd| {
        let ensemble = &formed.ensemble;
        let at = |moment: usize, k: usize| ensemble.places_at(moment)[k];
        let all = (1..ensemble.moments() - 1).flat_map(|m| (0..24).map(move |k| (m, k)));
        all.map(|(m, k)| (at(m - 1, k) - at(m, k) * 2.0 + at(m + 1, k)).length() * 100.0).fold(0.0, f64::max)
    };
    assert!(hardest_m_s2(&clear) < hardest_m_s2(&through) + 6.0, "{} m/s2", hardest_m_s2(&clear));
    // Key formations stay nearly as they were asked for.
    for moment in [0, 120, 240] {
        let places = clear.ensemble.places_at(moment).iter().zip(through.ensemble.places_at(moment));
        assert!(places.into_iter().all(|(a, b)| a.distance(*b) < 0.25), "{moment}");
    }
}

#[test]
fn everybody_on_one_point_is_parted() {
    let text = "duration_s = 3\n[[key]]\ntime_s = 0\npoints = [[1, 1], [1, 1], [1, 1], [1, 1], [1, 1]]\n";
    let here = formed(text).ensemble.places_at(15).to_vec();
    for (k, place) in here.iter().enumerate() {
        assert!(here[..k].iter().all(|other| other.distance(*place) >= 0.36 - 1e-9), "{here:?}");
        assert!(place.distance(vec2(1.0, 1.0)) < 1.5);
    }
    let one = formed(
        "example = { people = 1 }\n[[key]]\ntime_s = 0\npoints = [[1, 1]]\n[[key]]\ntime_s = 5\npoints = [[4, 1]]\n",
    );
    assert_eq!(one.ensemble.places_at(50), [vec2(4.0, 1.0)]);
}

#[test]
fn the_whole_goes_its_way_and_turns_along_it() {
    let text = "duration_s = 20\nexample = { people = 3 }\n\
                way = { from = [0, 0], to = [20, 0], from_s = 2, to_s = 18, follow_heading = true }\n\
                [[key]]\ntime_s = 0\nshape = \"wedge\"\nassign = \"order\"\n";
    let formed = formed(text);
    assert!(centroid(formed.ensemble.places_at(10)).length() < 1e-6);
    assert!(centroid(formed.ensemble.places_at(190)).distance(vec2(20.0, 0.0)) < 1e-6);
    let here = formed.ensemble.places_at(100);
    assert!(here[0].x > here[1].x + 0.5 && here[0].x > here[2].x + 0.5, "the first is in front: {here:?}");
}

#[test]
fn letters_are_formed() {
    let text = "example = { people = 60 }\nduration_s = 1\n[[key]]\ntime_s = 0\ntext = \"HI\"\nheight_m = 6\n";
    let places = formed(&format!("{OFF}{text}")).ensemble.places_at(0).to_vec();
    let near = |x: f64, y: f64| places.iter().any(|place| place.distance(vec2(x, y)) < 0.5);
    // The H's legs and bar, the I's leg; nothing between.
    assert!(near(-4.5, 0.0) && near(-2.5, 0.0) && near(-0.5, 2.0) && near(3.5, 0.0));
    assert!(!near(1.5, 0.0) && !near(-2.5, 2.0), "{places:?}");
}

#[test]
fn a_recording_is_an_example() {
    let folder = tempfile::tempdir().unwrap();
    let row = |k: u32, id: u32| format!("{id} {k} {:.3} {:.3}\n", f64::from(k) * 0.1, f64::from(id));
    let text: String = (0..50).flat_map(|k| (1..5).map(move |id| row(k, id))).collect();
    std::fs::write(folder.path().join("march.txt"), format!("# framerate: 10\n# id frame x/m y/m\n{text}")).unwrap();
    let ask = request(
        "avoid = { on = false }\nexample = { file = \"march.txt\", choose = [0, 2, 3] }\n[[key]]\ntime_s = 0\nshape = \"example\"\n\
         [[key]]\ntime_s = 8\nshape = \"line\"\nat = [3, 3]\n",
    );
    let formed = form(&ask, folder.path(), &Silent).unwrap_or_else(|error| panic!("{error}"));
    let start: Vec<Vec2> = [1.0, 3.0, 4.0].map(|y| vec2(0.0, y)).to_vec();
    assert!(apart_m(&start, formed.ensemble.places_at(0)) < 1e-6, "{:?}", formed.ensemble.places_at(0));
    assert!(apart_m(&[vec2(2.0, 3.0), vec2(3.0, 3.0), vec2(4.0, 3.0)], formed.ensemble.places_at(80)) < 1e-6);
    let missing = FormationRequest {
        example: ExampleRequest { file: Some(PathBuf::from("none.txt")), ..ExampleRequest::default() },
        ..ask
    };
    assert!(form(&missing, folder.path(), &Silent).unwrap_err().to_string().contains("none.txt"));
}

fn shape() -> impl Strategy<Value = FormationShape> {
    use FormationShape::*;
    prop::sample::select(vec![Example, Grid, Line, Ring, Disc, Triangle, Polygon, Star, Wedge])
}

prop_compose! {
    fn any_key()(
        shape in shape(), hold_s in 0.0..1.0f64, filled in any::<Option<bool>>(), turn_deg in -400.0..400.0f64,
        wheel_deg in prop::sample::select(vec![0.0, 180.0, -90.0, 33.0]), scale in prop::option::of(0.001..3.0f64),
        at in prop::option::of([-1e5..1e5f64, -5.0..5.0f64]), order in any::<bool>(), spacing in 0.05..3.0f64,
    ) -> KeyRequest {
        let fills = matches!(shape, FormationShape::Polygon | FormationShape::Star | FormationShape::Triangle);
        KeyRequest {
            shape: Some(shape), hold_s, filled: filled.filter(|_| fills), turn_deg, wheel_deg, scale,
            at: at.map(Vec2::from), assign: order.then_some(Assign::Order),
            spacing_m: (shape != FormationShape::Example).then_some(spacing), ..KeyRequest::default()
        }
    }
}

prop_compose! {
    fn any_request()(
        keys in prop::collection::vec(any_key(), 0..3), people in 0u32..7, fps in prop::sample::select(vec![0.2, 3.0, 10.0]),
        kind in prop::sample::select(vec![ExampleKind::Still, ExampleKind::Sway, ExampleKind::Ranks, ExampleKind::Wander]),
        together in prop::collection::vec(prop::collection::vec(0u32..7, 0..3), 0..2), inner in prop::option::of(any_key()),
        rider in any::<bool>(), even in any::<bool>(), duration_s in prop::option::of(0.0..9.0f64), every in 0u32..3,
        to_s in prop::option::of(0.01..3.0f64), repeat in any::<bool>(), distance in prop::option::of(0.0..2.0f64),
    ) -> FormationRequest {
        let spaced = |(k, key): (usize, KeyRequest)| KeyRequest { time_s: 2.0 * k as f64, ..key };
        let crowd = inner.map(|key| CrowdRequest {
            members: Members::Every { every, from: 1 }, rider, follow_heading: rider,
            example: ExampleRequest { people: Some(3), ..ExampleRequest::default() },
            key: vec![KeyRequest { at: None, ..key }], ..CrowdRequest::default()
        });
        FormationRequest {
            duration_s, fps: Some(fps),
            example: ExampleRequest {
                kind: Some(kind), people: Some(people), to_s,
                repeat: if repeat { Repeat::Loop } else { Repeat::ToAndFro }, ..ExampleRequest::default()
            },
            together, pace: even.then_some(Pace::Even), key: keys.into_iter().enumerate().map(spaced).collect(),
            avoid: AvoidRequest { distance_m: distance, ..AvoidRequest::default() },
            crowd: crowd.into_iter().collect(), ..FormationRequest::default()
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// Whatever is asked for: a crowd whose places are finite, or an error that says something.
    #[test]
    fn never_panics(request in any_request()) {
        match form(&request, Path::new(""), &Silent) {
            Ok(formed) => {
                prop_assert_eq!(formed.people.len(), formed.ensemble.people());
                for moment in 0..formed.ensemble.moments() {
                    prop_assert!(formed.ensemble.places_at(moment).iter().all(|place| place.is_finite()));
                }
            }
            Err(error) => prop_assert!(error.to_string().len() > 10),
        }
    }
}
