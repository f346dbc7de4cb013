//! What a user reads who made a mistake in a scenario. `SNAPSHOTS=overwrite cargo test` rewrites the texts.

use snapbox::{assert_data_eq, str};

use super::{PLAN, shown};

#[test]
fn a_wrong_key_shows_its_place_and_the_nearest_right_one() {
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nwal_height = 2.5\n"),
        str![[r#"
[plan] has no key `wal_height`
 --> plans/hall.toml:3:1
  |
3 | wal_height = 2.5
  | ^^^^^^^^^^
hint: did you mean `wall_height`?

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[bodies]\nseed = 3\n"),
        str![[r#"
[bodies] has no key `seed`
 --> plans/hall.toml:4:1
  |
4 | seed = 3
  | ^^^^
hint: `seed` belongs in [crowd] or [look] or [formation.example]

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[texture]\ncolour = 3\n"),
        str![[r#"
[texture] has no key `colour`
 --> plans/hall.toml:4:1
  |
4 | colour = 3
  | ^^^^^^
hint: its keys are floor_texels_per_metre, wall_texels_per_metre, tile, layers, bits, dirt, small_png, target, walls, embed, lightmap, lamps, ceiling, usd, sdf

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[look.film]\ndensty = 0.3\n"),
        str![[r#"
[look.film] has no key `densty`
 --> plans/hall.toml:4:1
  |
4 | densty = 0.3
  | ^^^^^^
hint: did you mean `density`?

"#]]
    );
}

#[test]
fn a_wrong_section_shows_its_place_and_the_nearest_right_one() {
    assert_data_eq!(
        shown("[plann]\nimage = \"plan.png\"\n"),
        str![[r#"
a scenario has no section `plann`
 --> plans/hall.toml:1:2
  |
1 | [plann]
  |  ^^^^^
hint: did you mean [plan]?

"#]]
    );
    assert_data_eq!(
        shown("seed = 3\n"),
        str![[r#"
a scenario has no section `seed`
 --> plans/hall.toml:1:1
  |
1 | seed = 3
  | ^^^^
hint: `seed` belongs in [crowd]

"#]]
    );
    assert_data_eq!(
        shown("plan = \"plan.png\"\n"),
        str![[r#"
`plan` is a section, not a value
 --> plans/hall.toml:1:1
  |
1 | plan = "plan.png"
  | ^^^^
hint: write [plan] on a line of its own, its keys below

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[route]\nfrom = \"west\"\n"),
        str![[r#"
`route` is a list of sections
 --> plans/hall.toml:3:2
  |
3 | [route]
  |  ^^^^^
hint: write [[route]] with two brackets, once per route

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[weather]\n"),
        str![[r#"
a scenario has no section `weather`
 --> plans/hall.toml:3:2
  |
3 | [weather]
  |  ^^^^^^^
hint: `weather` belongs in [marks.soil]

"#]]
    );
}

#[test]
fn a_wrong_type_shows_its_place_and_what_the_key_takes() {
    assert_data_eq!(
        shown("[plan]\nimage = 3\n"),
        str![[r#"
`image` takes a text in quotes, not 3
 --> plans/hall.toml:2:9
  |
2 | image = 3
  |         ^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nthreshold = 300\n"),
        str![[r#"
`threshold` takes a whole number from 0 to 255, not 300
 --> plans/hall.toml:3:13
  |
3 | threshold = 300
  |             ^^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nunknown = \"wal\"\n"),
        str![[r#"
`unknown` cannot be "wal"; it is one of wall, floor
 --> plans/hall.toml:3:11
  |
3 | unknown = "wal"
  |           ^^^^^
hint: did you mean "wall"?

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[bodies]\nstature_men = \"tall\"\n"),
        str![[r#"
`stature_men` takes a number, a range [low, high], or { mean = .., sd = .. }, not "tall"
 --> plans/hall.toml:4:15
  |
4 | stature_men = "tall"
  |               ^^^^^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nfloor = [[1]]\n"),
        str![[r#"
`floor` takes [x, y] in metres or { px = [x, y] } in pixels, not [1]
 --> plans/hall.toml:3:10
  |
3 | floor = [[1]]
  |          ^^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[crowd]\nseed = -1\n"),
        str![[r#"
`seed` takes a whole number of 0 or more, not -1
 --> plans/hall.toml:4:8
  |
4 | seed = -1
  |        ^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[crowd]\npreset = \"comuters\"\n"),
        str![[r#"
`preset` cannot be "comuters"; it is one of commuters, heavy, wet, paper
 --> plans/hall.toml:4:10
  |
4 | preset = "comuters"
  |          ^^^^^^^^^^
hint: did you mean "commuters"?

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[look]\nfloor = 3\n"),
        str![[r#"
`floor` takes a table of keys, not 3
 --> plans/hall.toml:4:9
  |
4 | floor = 3
  |         ^

"#]]
    );
}

#[test]
fn a_value_out_of_range_shows_its_place_and_the_range() {
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nwall_height = 3.5\n"),
        str![[r#"
`wall_height` is 3.5, allowed is at least 2.1, and less than 3.5
 --> plans/hall.toml:3:15
  |
3 | wall_height = 3.5
  |               ^^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = nan\n"),
        str![[r#"
`metres_per_pixel` is NaN, allowed is 0.0005 to 10
 --> plans/hall.toml:3:20
  |
3 | metres_per_pixel = nan
  |                    ^^^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[texture]\ntile = 0\n"),
        str![[r#"
`tile` is 0, allowed is 64 to 16384
 --> plans/hall.toml:4:8
  |
4 | tile = 0
  |        ^

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[bodies]\nstature_men = { mean = 1.7, sd = -1 }\n"),
        str![[r#"
`stature_men`: the standard deviation -1 is negative
 --> plans/hall.toml:4:15
  |
4 | stature_men = { mean = 1.7, sd = -1 }
  |               ^^^^^^^^^^^^^^^^^^^^^^^
hint: write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[bodies]\nstature_men = [1.5, 9]\n"),
        str![[r#"
`stature_men`: it can be as large as 9, allowed is 0.5 to 2.5
 --> plans/hall.toml:4:15
  |
4 | stature_men = [1.5, 9]
  |               ^^^^^^^^
hint: write a number, a range [0.28, 0.36], or { mean = 1.34, sd = 0.26, min = 0.6, max = 2.1 }

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[look]\nedge = { corner = 9.5 }\n"),
        str![[r#"
`corner` is 9.5, allowed is 1 to 4
 --> plans/hall.toml:4:19
  |
4 | edge = { corner = 9.5 }
  |                   ^^^

"#]]
    );
}

#[test]
fn text_that_is_not_toml_shows_its_place() {
    assert_data_eq!(
        shown("[plan\nimage = \"plan.png\"\n"),
        str![[r#"
not valid TOML: unclosed table, expected `]`
 --> plans/hall.toml:1:6
  |
1 | [plan
  |      ^
hint: texts stand in quotes, lists in [brackets], and a section begins with its [name]

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = plan.png\n"),
        str![[r#"
not valid TOML: string values must be quoted, expected literal string
 --> plans/hall.toml:2:9
  |
2 | image = plan.png
  |         ^^^^^^^^
hint: texts stand in quotes, lists in [brackets], and a section begins with its [name]

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"a.png\"\nimage = \"b.png\"\n"),
        str![[r#"
not valid TOML: duplicate key
 --> plans/hall.toml:3:1
  |
3 | image = "b.png"
  | ^^^^^
hint: write each key and each section once; only [[route]], [[stop]], [[door]], [[fixture]] and [[unit]] may come again

"#]]
    );
}

#[test]
fn what_contradicts_itself_is_refused() {
    assert_data_eq!(
        shown("[crowd]\nseed = 3\n"),
        str![[r#"
plans/hall.toml: the scenario names no plan
hint: write [plan] image = "plan.png"; only a given motion needs no plan

"#]]
    );
    assert_data_eq!(
        shown(
            "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n\
             scale = { from = { px = [0, 0] }, to = { px = [9, 0] }, metres = 3 }\n"
        ),
        str![[r#"
[plan] has both metres_per_pixel and scale
 --> plans/hall.toml:4:9
  |
4 | scale = { from = { px = [0, 0] }, to = { px = [9, 0] }, metres = 3 }
  |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
hint: leave one of the two out

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[look]\npreset = \"wet\"\nfile = \"a.toml\"\n"),
        str![[r#"
[look] has both a preset and a file
 --> plans/hall.toml:5:8
  |
5 | file = "a.toml"
  |        ^^^^^^^^
hint: a look file names its own preset: leave one of the two out

"#]]
    );
    assert_data_eq!(
        shown("[plan]\nimage = \"plan.png\"\n[look]\nfile = \"nowhere.toml\"\n"),
        str![[r#"
cannot read the look file plans/nowhere.toml: No such file or directory (os error 2)
 --> plans/hall.toml:4:8
  |
4 | file = "nowhere.toml"
  |        ^^^^^^^^^^^^^^

"#]]
    );
}

#[test]
fn a_wrong_route_shows_its_place() {
    let text = |line: &str| {
        format!("{PLAN}[[route]]\nfrom = \"west\"\nto = \"north\"\n\n[[route]]\nfrom = \"west\"\n{line}\n")
    };
    assert_data_eq!(
        shown(&text("")),
        str![[r#"
`to` is missing in [[route]]
 --> plans/hall.toml:7:1
  |
7 | [[route]]
  | ^^^^^^^^^

"#]]
    );
    assert_data_eq!(
        shown(&text("to = 3")),
        str![[r#"
`to` takes an opening's name, a point [x, y], or an area [[x0, y0], [x1, y1]], not 3
 --> plans/hall.toml:9:6
  |
9 | to = 3
  |      ^

"#]]
    );
    assert_data_eq!(
        shown(&text("too = \"north\"")),
        str![[r#"
[[route]] has no key `too`
 --> plans/hall.toml:9:1
  |
9 | too = "north"
  | ^^^
hint: did you mean `to`?

"#]]
    );
    assert_data_eq!(
        shown(&text("to = \"north\"\nshare = -1")),
        str![[r#"
`share` is -1, allowed is 0.000001 to 1000000
  --> plans/hall.toml:10:9
   |
10 | share = -1
   |         ^^

"#]]
    );
    assert_data_eq!(
        shown(&text("to = [1, 2, 3]")),
        str![[r#"
`to` takes an opening's name, a point [x, y], or an area [[x0, y0], [x1, y1]], not [1, 2, 3]
 --> plans/hall.toml:9:6
  |
9 | to = [1, 2, 3]
  |      ^^^^^^^^^

"#]]
    );
}
