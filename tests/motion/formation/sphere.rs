//! Three people: eigenvectors as recorded, and as a rotation from the first to the last has them.

use trodden::formation::{Agreement, sphere_tracks};
use trodden::math::{Vec2, vec2};
use trodden::motion::Ensemble;

use super::crowds::walking_between;

/// Three who walk abreast; the one in the middle moves over from one neighbour to the other, who falls behind: two pairs of
/// neighbours throughout.
fn moving_over(seed: u64) -> Ensemble {
    let formation = |share: f64| -> Vec<Vec2> {
        let (sine, cosine) = trodden::math::sin_cos(0.6 * share);
        vec![vec2(0.0, 0.9 + 0.35 * share), vec2(0.0, 0.0), vec2(-sine, -cosine) * (1.25 - 0.35 * share)]
    };
    walking_between(formation, 25.0, 4.0, seed)
}

#[test]
fn turned_vectors_are_near_the_recorded_ones() {
    for seed in 0..10 {
        let example = moving_over(seed);
        assert_eq!(Agreement::one_pattern(&example, 1.55).len(), 1, "one pattern of adjacency throughout");
        let tracks = sphere_tracks(&example, None).unwrap();
        let degrees = tracks.mean_angles_rad().map(f64::to_degrees);
        assert!(degrees.iter().all(|&mean| mean < 5.0), "seed {seed}: {degrees:?} degrees");
        // They do turn, or there would be nothing to see.
        let turned = tracks.turned[0][0].iter().zip(&tracks.turned[100][0]).map(|(a, b)| a * b).sum::<f64>();
        assert!(turned < 0.98, "seed {seed}: {turned}");
        for (recorded, turned) in tracks.recorded.iter().zip(&tracks.turned) {
            for vector in recorded.iter().chain(turned) {
                assert!((vector.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
                assert!(vector.iter().sum::<f64>().abs() < 1e-12, "on the great circle around the constant vector");
            }
        }
    }
}

#[test]
fn ends_are_the_recorded_ones() {
    let tracks = sphere_tracks(&moving_over(3), None).unwrap();
    for end in [0, tracks.recorded.len() - 1] {
        for (a, b) in tracks.recorded[end].iter().flatten().zip(tracks.turned[end].iter().flatten()) {
            assert!((a - b).abs() < 1e-12);
        }
    }
}

#[test]
fn patterns_change_where_somebody_comes_near() {
    let places = [3.0, 2.0, 0.9, 0.8, 2.0].iter().flat_map(|&x| [vec2(0.0, 0.0), vec2(x, 0.0)]).collect();
    let example = Ensemble::new(1.0, 0.0, vec![1, 2], places);
    assert_eq!(Agreement::one_pattern(&example, 1.0), [0..2, 2..4, 4..5]);
}

/// `--check` on the three as a recording of their own: as near as above. Three who change places keep to no rotation.
#[test]
fn a_users_own_recording_is_checked() {
    let folder = tempfile::tempdir().unwrap();
    let check = |crowd: &Ensemble, more: &[&str]| {
        let mut text = String::from("# framerate: 25\n# id frame x/m y/m\n");
        for moment in 0..crowd.moments() {
            for (id, place) in crowd.places_at(moment).iter().enumerate() {
                text += &format!("{} {moment} {:.4} {:.4}\n", id + 1, place.x, place.y);
            }
        }
        std::fs::write(folder.path().join("three.txt"), text).unwrap();
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_trodden"));
        let command = command.args(["motion", "formation", "--check", "three.txt"]).args(more);
        let output = command.current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let slowly = |share: f64| vec![vec2(0.0, 0.9 + 0.35 * share), vec2(0.0, 0.0), vec2(0.0, -1.25 + 0.35 * share)];
    let there = |share: f64| {
        let (sine, cosine) = trodden::math::sin_cos(40.0 * share);
        vec![vec2(0.0, 0.0), vec2(1.2 * cosine, 1.2 * sine), vec2(1.6 + 0.9 * sine, 0.0)]
    };
    let mean = |crowd: &Ensemble| -> f64 {
        let found: serde_json::Value = serde_json::from_str(&check(crowd, &["--json"])).unwrap();
        found["angles"].as_array().unwrap().last().unwrap()["mean_deg"].as_f64().unwrap()
    };
    let [slow, wild] = [mean(&walking_between(slowly, 25.0, 6.0, 1)), mean(&walking_between(there, 25.0, 6.0, 1))];
    assert!(slow < 5.0 && wild > 2.0 * slow, "{slow} {wild}");
    let text = check(&walking_between(slowly, 25.0, 6.0, 1), &[]);
    assert!(text.contains("two pairs are near") && text.lines().count() == 7, "{text}");
}
