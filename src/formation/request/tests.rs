use super::*;
use crate::options::{Options, parse};

fn read<T: Options>(text: &str) -> T {
    parse(text).unwrap_or_else(|mistake| panic!("{}\n{text}", mistake.explain(text).0))
}

/// What is wrong: the key and the problem.
fn problem(text: &str) -> (String, String) {
    let error = read::<FormationRequest>(text).check().unwrap_err();
    (error.key().to_string(), error.problem())
}

#[test]
fn what_is_wrong_is_named_by_its_key() {
    for (text, key, says) in [
        ("fps = 0", "formation.fps", "0.1 to 1000"),
        ("duration_s = nan", "formation.duration_s", "NaN"),
        ("together = [[0, 1], [2]]", "formation.together.1", "1 named"),
        ("together = [[4, 4]]", "formation.together.0", "4 is named twice"),
        ("adjacency = [{ members = [0, 1], weight = 2 }]", "formation.adjacency.0.weight", "0 to 1"),
        ("way = {}", "formation.way", "no points"),
        ("way = { from = [0, inf] }", "formation.way.path", "out of range"),
        ("way = { to = [0, 1], from_s = 3, to_s = 2 }", "formation.way.to_s", "before it begins"),
        ("example = { file = \"a.txt\", kind = \"ranks\" }", "formation.example.kind", "both"),
        ("example = { rows = 90, columns = 90 }", "formation.example.rows", "8100 people"),
        ("example = { rows = 2, columns = 2, people = 5 }", "formation.example.people", "do not stand"),
        ("example = { choose = [] }", "formation.example.choose", "0 named"),
        ("example = { from_s = 3, to_s = 3 }", "formation.example.to_s", "ends before"),
        ("[[key]]\ntime_s = 0", "formation.key.0", "has no positions"),
        ("[[key]]\ntime_s = 0\nshape = \"ring\"\ntext = \"A\"", "formation.key.0.text", "both `shape` and `text`"),
        ("[[key]]\ntime_s = 0\nshape = \"ring\"\ncolumns = 3", "formation.key.0.columns", "to a grid only"),
        ("[[key]]\ntime_s = 0\npoints = [[0, 0]]\nspacing_m = 3", "formation.key.0.spacing_m", "only"),
        ("[[key]]\ntime_s = 0\npoints = [[0, 0], [0, 1e9]]", "formation.key.0.points.1", "out of range"),
        ("[[key]]\ntime_s = 0\ntext = \"A\u{fc}\"", "formation.key.0.text", "\u{fc}"),
        ("[[key]]\ntime_s = 0\ntext = \" \"", "formation.key.0.text", "letters"),
        (
            "[[key]]\ntime_s = 4\nshape = \"ring\"\n[[key]]\ntime_s = 4\nshape = \"disc\"",
            "formation.key.1.time_s",
            "4 s",
        ),
        ("duration_s = 9\n[[key]]\ntime_s = 8\nhold_s = 2\nshape = \"ring\"", "formation.key.0.time_s", "ends at 10 s"),
        ("[[crowd]]\nmembers = { every = 0 }", "formation.crowd.0.members", "every"),
        ("[[crowd]]\nrider = true\nas_one = false", "formation.crowd.0.as_one", "together"),
        (
            "[[crowd]]\n[[crowd.key]]\ntime_s = 0\nshape = \"ring\"\nat = [0, 0]",
            "formation.crowd.0.key.0.at",
            "no position of its own",
        ),
        ("[[crowd]]\n[[crowd.crowd]]\nsigma_m = 0", "formation.crowd.0.crowd.0.sigma_m", "allowed"),
    ] {
        let (found, problem) = problem(text);
        assert_eq!(found, key, "{text}: {problem}");
        assert!(problem.contains(says), "{text}: {problem}");
    }
}

#[test]
fn crowds_are_not_nested_without_end() {
    let mut crowd = CrowdRequest::default();
    for _ in 0..DEEPEST {
        crowd = CrowdRequest { crowd: vec![crowd], ..CrowdRequest::default() };
    }
    let request = FormationRequest { crowd: vec![crowd], ..FormationRequest::default() };
    assert!(request.check().unwrap_err().to_string().contains("deep"));
}

#[test]
fn members_are_all_some_or_every_so_many() {
    let members = |text: &str| {
        let crowd: CrowdRequest = read(text);
        (0..7).filter(|&k| crowd.members.contains(k)).collect::<Vec<_>>()
    };
    assert_eq!(members(""), [0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(members("members = \"all\""), [0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(members("members = [4, 1]"), [1, 4]);
    assert_eq!(members("members = { every = 2 }"), [0, 2, 4, 6]);
    assert_eq!(members("members = { every = 3, from = 1 }"), [1, 4]);
}

#[test]
fn what_is_written_reads_back_the_same() {
    let text = "duration_s = 9.0\nway = { path = [[0, 1], [2, 3]] }\nexample = { kind = \"wander\", people = 4, choose = [[0, 1]] }\n\
                [[key]]\ntime_s = 0\nshape = \"star\"\nfilled = true\n[[crowd]]\nmembers = { every = 2 }\n[[crowd.crowd]]\nrider = true\n";
    let request: FormationRequest = read(text);
    let written = toml::to_string(&request.table()).unwrap();
    assert_eq!(read::<FormationRequest>(&written), request, "{written}");
}
