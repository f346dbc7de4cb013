//! Every key of a scenario: what it means, what it may be, in the order in which `trodden init` writes them.

/// The sections of a scenario, in order.
pub(super) const SECTIONS: [&str; 16] = [
    "plan", "walls", "texture", "crowd", "motion", "bodies", "marks", "stamps", "look", "patterns", ROUTE, STOP, DOOR,
    FIXTURE, UNIT, FORMATION,
];
/// The section that makes a crowd change from formation to formation, and the lists of sections within it.
pub(super) const FORMATION: &str = "formation";
pub(super) const FORMATION_SECTIONS: [&str; 6] =
    [FORMATION, "formation.example", "formation.way", "formation.avoid", "formation.key", "formation.crowd"];
/// The section that comes once per route.
pub(super) const ROUTE: &str = "route";
/// The section that comes once per stop.
pub(super) const STOP: &str = "stop";
/// The section that comes once per door.
pub(super) const DOOR: &str = "door";
/// The section that comes once per fixture.
pub(super) const FIXTURE: &str = "fixture";
/// The section that comes once per spot at which units are played.
pub(super) const UNIT: &str = "unit";
/// The sections that may come several times.
pub(super) const LISTS: [&str; 5] = [ROUTE, STOP, DOOR, FIXTURE, UNIT];

/// One key.
pub(super) struct Key {
    /// With its section, as in `look.film.density`.
    pub path: &'static str,
    /// What it may be.
    pub allowed: Allowed,
    /// What it is: one line, without the range.
    pub about: &'static str,
    /// What it looks like where it has no default.
    pub example: &'static str,
}

/// What a key's value may be, beyond its type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowed {
    /// Whatever its type takes, or what the plan, the library or the file system decide.
    Any,
    /// A number, or a list of numbers, from .. to, both included.
    Number(f64, f64),
    /// As `Number`, but less than the second.
    Below(f64, f64),
    /// A quantity that differs from person to person: all that can be drawn lies from .. to.
    Spread(f64, f64),
}

impl Key {
    /// The section, as in `look.film`.
    pub fn section(&self) -> &'static str {
        self.path.rsplit_once('.').map_or("", |(section, _)| section)
    }

    /// The key without its section.
    pub fn name(&self) -> &'static str {
        self.path.rsplit_once('.').map_or(self.path, |(_, name)| name)
    }
}

/// The sections that have a key of this name.
pub(super) fn sections_with(name: &str) -> Vec<&'static str> {
    KEYS.iter().filter(|key| key.name() == name).map(Key::section).collect()
}

/// The least and the largest value of a key such as `crowd.people`, where it is a number with a range.
pub fn allowed_range(path: &str) -> Option<[f64; 2]> {
    match KEYS.iter().find(|key| key.path == path)?.allowed {
        Allowed::Number(low, high) | Allowed::Below(low, high) | Allowed::Spread(low, high) => Some([low, high]),
        Allowed::Any => None,
    }
}

/// Whether a key takes one value even where it is written as a table.
pub(super) fn is_one_value(path: &str) -> bool {
    KEYS.iter().any(|key| key.path == path)
}

const fn key(path: &'static str, allowed: Allowed, about: &'static str) -> Key {
    Key { path, allowed, about, example: "" }
}

const fn optional(path: &'static str, allowed: Allowed, about: &'static str, example: &'static str) -> Key {
    Key { path, allowed, about, example }
}

use Allowed::{Any, Below, Number, Spread};

/// Every key. [`Allowed`] narrows what a stage itself would take, never widens it.
#[rustfmt::skip]
pub(super) const KEYS: &[Key] = &[
    optional("plan.image", Any, "the plan: PNG, JPEG, BMP, PGM, TIFF, GIF, or the YAML of a ROS map; relative to this file", "\"plan.png\""),
    optional("plan.metres_per_pixel", Number(0.0005, 10.0), "side of a pixel [m]", "0.05"),
    optional("plan.scale", Any, "or two points and how far apart they are",
        "{ from = { px = [120, 40] }, to = { px = [480, 40] }, metres = 36.0 }"),
    key("plan.wall_height", Below(2.1, 3.5), "height of the walls [m]"),
    optional("plan.threshold", Number(1.0, 255.0), "lightness at which wall ends and floor begins", "128"),
    key("plan.wall_colours", Any, "saturated colours that are wall, as \"#c03030\"; all others are notes on the floor"),
    key("plan.unknown", Any, "a ROS map's unknown pixels: \"wall\" or \"floor\""),
    key("plan.transparent", Any, "transparent pixels: \"auto\", \"paper\", \"wall\" or \"floor\""),
    key("plan.speck_m", Number(0.0, 10.0), "smaller specks are dropped as noise [m]"),
    key("plan.drop_annotation", Any, "whether lettering, dashed lines and the outlines of coloured dots are dropped"),
    key("plan.floor", Any, "points in the floor, [x, y] in metres or { px = [x, y] }; empty: found"),
    key("plan.narrowest_m", Number(0.1, 2.0), "width of the narrowest person: nobody goes where they cannot pass [m]"),

    key("walls.tolerance_px", Number(0.05, 10.0), "how far traced walls may lie from the drawn ones [pixels of the plan]"),

    key("texture.floor_texels_per_metre", Number(1.0, 1000.0), "texel density of the floor"),
    key("texture.wall_texels_per_metre", Number(1.0, 1000.0), "texel density of the walls"),
    key("texture.tile", Number(64.0, 16384.0), "largest side of a texture [px]; Unreal takes 8192"),
    optional("texture.layers", Any, "whether every layer is an EXR too; left out: for gltf and blender only", "true"),
    key("texture.target", Any, "what the files are for: \"gltf\", \"blender\", \"unreal\", \"unity\" or \"godot\""),
    key("texture.walls", Any, "whether walls are made too, and with them the scene, stills and page"),
    key("texture.embed", Any, "whether scene.glb carries its textures, reduced, inside"),

    key("crowd.preset", Any, "what all other keys start from: \"commuters\", \"heavy\", \"wet\" or \"paper\""),
    key("crowd.model", Any, "what moves people: \"boids\", or \"social-force\" with groups of up to four"),
    key("crowd.seed", Any, "another number, another crowd"),
    key("crowd.people", Number(1.0, 5e6), "how many people walk"),
    key("crowd.speed", Spread(0.1, 6.0), "with nobody around [m/s]"),
    key("crowd.speed_law", Any, "how density slows people down: \"weidmann\" or \"linear\""),
    key("crowd.exclusion", Spread(0.05, 1.5), "bodies' middles never come nearer to each other [m]"),
    key("crowd.acceptable", Spread(0.05, 5.0), "people make way before they come so near; shrinks with density [m]"),
    key("crowd.wall_exclusion", Spread(0.0, 2.0), "the same for walls; shrinks in gaps [m]"),
    key("crowd.wall_acceptable", Spread(0.0, 5.0), "people keep this far off walls if they can; shrinks in gaps [m]"),
    key("crowd.alignment", Number(0.0, 5.0), "how quickly people take up the line of those who go their way, per second"),
    key("crowd.entry_rate", Number(1e-3, 1e3), "the most who enter in a second, per metre of opening"),
    optional("crowd.entry_seconds", Number(0.0, 1e6), "seconds over which people enter; left out: by the rate", "600.0"),
    key("crowd.patience_seconds", Number(5.0, 1e5), "who makes no way for so long is stuck"),
    key("crowd.time_step", Number(0.01, 0.2), "of the simulation [s]"),
    optional("crowd.end_seconds", Number(0.1, 1e7), "ends the walk, wherever people are", "3600.0"),
    optional("crowd.period_x", Number(8.0, 1e5), "who leaves in x comes back at the other end [m]; for measurements", "26.0"),

    key("crowd.arrivals.kind", Any, "when people come: \"rate\" (evenly), \"bursts\" (a train every few minutes) or \"list\""),
    optional("crowd.arrivals.first_s", Number(0.0, 1e7), "of a rate and of bursts: when the first come", "30.0"),
    optional("crowd.arrivals.per_second", Number(1e-4, 1e3), "of a rate: people per second; left out: by entry_rate", "0.5"),
    optional("crowd.arrivals.every_s", Number(1.0, 1e7), "of bursts: from one to the next", "360.0"),
    optional("crowd.arrivals.people", Number(1.0, 5e6), "of bursts: how many come in one", "120"),
    optional("crowd.arrivals.share", Number(1e-6, 1.0), "of bursts: or which share of all people comes in one", "0.25"),
    optional("crowd.arrivals.spread_s", Number(0.0, 1e7), "of bursts: how long the people of one take to come; 0: all at once", "45.0"),
    optional("crowd.arrivals.times", Any, "of a list: times [s], each with how many come then", "[[60, 20], [300, 80]]"),
    optional("crowd.arrivals.file", Any, "of a list: a CSV file of them, relative to this file", "\"arrivals.csv\""),

    key("crowd.groups.shares", Number(0.0, 1e6), "social-force: of all groups, which share has 1, 2, 3 and 4 people"),
    key("crowd.groups.slowdown", Number(0.0, 0.5), "how much more slowly each further member wants to walk [m/s]"),
    key("crowd.groups.gaze", Number(0.0, 20.0), "strength of the wish to have the others in view [per s and radian]"),
    key("crowd.groups.cohesion", Number(0.0, 20.0), "pull towards the group's middle for who is far from it [m/s2]"),
    key("crowd.groups.repulsion", Number(0.0, 20.0), "push away from members who are too near [m/s2]"),
    key("crowd.groups.distance", Number(0.2, 3.0), "what is too near [m]"),
    key("crowd.groups.view_deg", Number(10.0, 180.0), "how far to either side people see with the head straight [degrees]"),
    key("crowd.groups.reach", Number(0.1, 3.0), "what is far from the middle, per further member [m]"),

    key("crowd.social_force.relaxation", Number(0.1, 5.0), "social-force: how long it takes to walk as one wants [s]"),
    key("crowd.social_force.strength", Number(0.0, 50.0), "how hard others push [m/s2]"),
    key("crowd.social_force.range", Number(0.05, 2.0), "how far, for those who keep their distance [m]"),
    key("crowd.social_force.foresight", Number(0.0, 10.0), "how much more those count who come nearer [s]"),
    key("crowd.social_force.aside_width", Number(0.0, 20.0), "how narrowly ahead others make one step aside [per m and radian]"),
    key("crowd.social_force.slowing_width", Number(0.0, 20.0), "how narrowly ahead others slow one down [per m and radian]"),
    key("crowd.social_force.behind", Number(0.0, 1.0), "what somebody behind counts against somebody ahead"),
    key("crowd.social_force.wall_strength", Number(0.0, 50.0), "how hard a wall pushes that is touched [m/s2]"),
    key("crowd.social_force.wall_range", Number(0.01, 2.0), "over which distance that falls to 1/e [m]"),
    key("crowd.social_force.fluctuation", Number(0.0, 3.0), "how unevenly people walk of themselves: deviation [m/s2]"),
    key("crowd.social_force.most_speed", Number(1.0, 2.0), "nobody walks faster than so many times their own speed"),

    optional("motion.file", Any, "a recording that takes the crowd's place; relative to this file; without a plan the floor is open ground",
        "\"paths.txt\""),
    optional("motion.format", Any, "how it is written; left out: found", "\"juelich\""),
    optional("motion.unit", Any, "of its lengths, \"m\", \"cm\", \"mm\" or \"ft\"; left out: found", "\"cm\""),
    optional("motion.fps", Number(0.01, 1000.0), "frames per second, where it counts frames; left out: found", "25"),
    optional("motion.columns", Any, "what its columns mean, in order; - for one of no use", "\"id,frame,x,y,-\""),
    key("motion.origin", Any, "the point that stays where it is when the recording is turned [m]"),
    key("motion.shift", Any, "how far the recording is moved [m]"),
    key("motion.rotation_deg", Number(-360.0, 360.0), "how far it is turned, counter-clockwise [degrees]"),

    key("bodies.men", Number(0.0, 1.0), "share of men among the grown-ups"),
    key("bodies.children", Number(0.0, 1.0), "share of children among all"),
    key("bodies.stature_men", Spread(0.5, 2.5), "body height [m]"),
    key("bodies.stature_women", Spread(0.5, 2.5), "body height [m]"),
    key("bodies.stature_children", Spread(0.5, 2.5), "body height [m]"),
    key("bodies.bags", Number(0.0, 1.0), "share of people who carry a bag"),
    optional("bodies.step_length", Spread(0.15, 2.0), "a fixed step length [m]; left out: it follows speed and stature", "0.7"),
    key("bodies.step_width", Spread(0.0, 0.5), "between the lines of a man's feet, walking freely; women's: 0.88 of it [m]"),
    key("bodies.toe_out_deg", Spread(-45.0, 45.0), "how far a man's toes point outward; women's: 0.86 of it [degrees]"),

    key("marks.fresh_people", Any, "how many of the last people leave readable prints: those since the floor was mopped"),
    optional("marks.shoe", Any, "the one sole that everybody wears; left out: by share", "\"leather_shoe\""),
    key("marks.shifts_per_minute", Number(0.0, 60.0), "how often somebody who stands sets a foot anew"),
    key("marks.soil.weather", Any, "outside: \"dry\" or \"wet\""),
    key("marks.soil.median_density", Number(0.0, 3.0), "optical density of a first print"),
    key("marks.soil.sigma", Number(0.0, 3.0), "how widely people's loads differ: deviation of the logarithm"),
    key("marks.soil.shoe_sigma", Number(0.0, 3.0), "the same between the two shoes of a person"),
    key("marks.soil.mat_length_m", Number(0.0, 100.0), "length of the mat inside an entrance [m]"),
    key("marks.soil.steps_before_entering", Spread(0.0, 1e6), "steps of a shoe since the soil, for who comes in"),
    key("marks.soil.steps_before_indoors", Spread(0.0, 1e6), "the same for who starts inside"),
    key("marks.heel.per_metre", Number(0.0, 1.0), "heel marks per metre walked"),
    key("marks.heel.per_radian", Number(0.0, 1.0), "per radian turned at a walk"),
    key("marks.heel.per_stop", Number(0.0, 10.0), "per stop, and per start"),
    key("marks.heel.per_second_stood", Number(0.0, 1.0), "per second stood"),
    key("marks.heel.per_passage", Number(0.0, 10.0), "per passage of a door or another narrow place"),
    key("marks.heel.narrow_m", Number(0.0, 5.0), "what counts as narrow [m]"),
    key("marks.heel.median_density", Number(0.0, 3.0), "optical density of a mark"),
    key("marks.heel.sigma", Number(0.0, 3.0), "deviation of its logarithm"),
    key("marks.heel.people", Number(1.0, 1e9), "the number of people for which the rates hold; fewer leave more each"),
    key("marks.contact.rule", Any, "what decides where walls are touched: \"causes\", or \"distance\" alone as in the paper"),
    key("marks.contact.people", Number(1.0, 1e9), "for how many people touches are drawn: who walks stands for up to 64; 1: for those who walk"),
    key("marks.contact.reach_m", Number(0.1, 1.0), "how far hands and belongings reach from the body's side [m]"),
    key("marks.contact.close_m", Number(0.0, 1.0), "how near shoulders, arms and hips come to touch [m]"),
    key("marks.contact.narrow_m", Number(0.0, 3.0), "clear width below which shoulders brush walls [m]"),
    key("marks.contact.hand_per_metre", Number(0.0, 10.0), "hands on a plain wall, per metre walked within reach"),
    key("marks.contact.arm_per_metre", Number(0.0, 10.0), "elbows, arms and hips, per metre walked very close"),
    key("marks.contact.shoulder_per_metre", Number(0.0, 10.0), "shoulders, per metre walked very close where it is narrow"),
    key("marks.contact.bag_per_metre", Number(0.0, 10.0), "belongings, per metre within reach with some on the wall's side"),
    key("marks.contact.shoe_per_metre", Number(0.0, 10.0), "shoes, per metre walked within reach"),
    key("marks.contact.jamb_hand_per_passage", Number(0.0, 10.0), "hands on a door's jamb, per passage"),
    key("marks.contact.jamb_shoulder_per_passage", Number(0.0, 10.0), "shoulders and arms on it, where the door is narrow"),
    key("marks.contact.jamb_bag_per_passage", Number(0.0, 10.0), "belongings against it, with some on that side"),
    key("marks.contact.jamb_shoe_per_passage", Number(0.0, 10.0), "shoes against it"),
    key("marks.contact.corner_per_turn", Number(0.0, 10.0), "hands on the corner that one turns round, per turn"),
    key("marks.contact.corner_bag_per_turn", Number(0.0, 10.0), "belongings against it, with some on that side"),
    key("marks.contact.corner_shoe_per_turn", Number(0.0, 10.0), "shoes against it"),
    key("marks.contact.lean_per_second", Number(0.0, 1.0), "whatever who stands very close leans on a wall, per second"),
    key("marks.contact.fixture_per_passage", Number(0.0, 10.0), "touches of a fixture, per passage within reach"),
    key("marks.contact.fixture_per_second", Number(0.0, 1.0), "touches of it, per second stood within reach"),
    key("marks.contact.distance_close_per_metre", Number(0.0, 10.0), "rule \"distance\": touches at the wall, per metre; none from close_m on"),
    key("marks.contact.distance_far_per_metre", Number(0.0, 10.0), "the same of hand and belongings; none from reach_m on"),
    key("marks.contact.hand_density", Number(0.0, 3.0), "median optical density of a hand's touch"),
    key("marks.contact.arm_density", Number(0.0, 3.0), "of an arm's"),
    key("marks.contact.shoulder_density", Number(0.0, 3.0), "of a shoulder's"),
    key("marks.contact.bag_density", Number(0.0, 3.0), "of a bag's"),
    key("marks.contact.shoe_density", Number(0.0, 3.0), "of a shoe's"),
    key("marks.contact.sigma", Number(0.0, 3.0), "deviation of their logarithm"),

    key("stamps.partial", Number(0.0, 1.0), "share of prints that show only the heel, only the ball, or fade to one side"),
    key("stamps.pressure", Number(0.0, 0.4), "how unevenly a sole presses"),
    key("stamps.blur_m", Number(0.0, 0.02), "least and largest blur of a print [m]"),
    key("stamps.noise", Number(0.0, 0.6), "blotches and grain in a print"),
    key("stamps.presence_across_m", Number(0.01, 1.0), "width of the soft trace that a footfall adds to the lane [m]"),
    key("stamps.presence_along_m", Number(0.01, 1.0), "its length [m]"),

    key("look.preset", Any, "\"commuters\", \"heavy\", \"wet\" or \"paper\": what this section's keys start from"),
    optional("look.file", Any, "or a look file, relative to this file", "\"vinyl.toml\""),
    key("look.seed", Any, "another number, another noise"),
    key("look.total_passes", Number(1.0, 1e9), "how many people the floor has seen; the simulated ones stand for them"),
    key("look.darkest", Number(0.0, 255.0), "sRGB value below which dirt darkens nothing"),
    key("look.floor.material", Any, "what is under the dirt"),
    optional("look.floor.colour", Any, "sRGB of the clean floor; left out: the material's", "[198, 194, 186]"),
    key("look.floor.texture", Number(0.0, 3.0), "how much of the material's own texture shows"),
    optional("look.floor.image", Any, "or an image of the clean floor, repeated", "\"oak.png\""),
    key("look.floor.image_size_m", Number(0.01, 1000.0), "width and height of the floor that the image shows [m]"),
    optional("look.floor.roughness", Number(0.0, 1.0), "of the clean floor; left out: the material's", "0.35"),
    optional("look.floor.roughness_trodden", Number(0.0, 1.0), "where many have walked; left out: the material's", "0.5"),
    key("look.floor.tile_m", Number(0.02, 5.0), "side of a tile, material \"tile\" [m]"),
    key("look.floor.joint_m", Number(0.0, 0.05), "width of a joint, material \"tile\" [m]"),
    key("look.film.density", Number(0.0, 3.0), "optical density of the lane, once complete"),
    key("look.film.per_pass", Number(0.0, 1.0), "share of what is still missing that one pass adds"),
    key("look.film.spread_m", Number(0.0, 0.5), "how far simulated passes are evened out, for those beside them [m]"),
    key("look.film.colour", Any, "sRGB"),
    key("look.ingrained.density", Number(0.0, 3.0), "what darkens on long after the film is complete"),
    key("look.ingrained.per_pass", Number(0.0, 1.0), "share of what is still missing that one pass adds"),
    key("look.prints.soil", Number(0.0, 20.0), "factor on the soil of fresh prints"),
    key("look.prints.every_pass", Number(0.0, 3.0), "optical density that every print paints: the paper's way"),
    key("look.prints.colour", Any, "sRGB"),
    key("look.scuffs.strength", Number(0.0, 20.0), "factor on heel and toe marks"),
    key("look.scuffs.colour", Any, "sRGB"),
    key("look.edge.density", Number(0.0, 3.0), "optical density of the skirting line at the wall"),
    key("look.edge.reach_m", Number(0.005, 0.5), "falls to 1/e in this distance [m]"),
    key("look.edge.unevenness", Number(0.0, 1.5), "how broken the line is"),
    key("look.edge.corner", Number(1.0, 4.0), "how many times as much lies in an inner corner"),
    key("look.edge.corner_radius_m", Number(0.01, 0.5), "how far a corner is felt [m]"),
    key("look.edge.colour", Any, "sRGB"),
    key("look.dust.density", Number(0.0, 3.0), "optical density of dust at the wall"),
    key("look.dust.reach_m", Number(0.02, 3.0), "falls to 1/e in this distance [m]"),
    key("look.dust.colour", Any, "sRGB"),
    key("look.noise.fine", Any, "grain: size of a spot [m], deviation of the logarithm"),
    key("look.noise.middle", Any, "blotches"),
    key("look.noise.coarse", Any, "clouds"),

    key("look.wall.material", Any, "\"matt\" or \"gloss\" paint, or \"concrete\": colour, texture, how stains stay on it"),
    optional("look.wall.colour", Any, "sRGB of the clean wall; left out: the material's", "[228, 227, 223]"),
    key("look.wall.texture", Number(0.0, 3.0), "how much of the material's own texture shows; paint has none"),
    optional("look.wall.image", Any, "or an image of the clean wall, repeated", "\"brick.png\""),
    key("look.wall.image_size_m", Number(0.01, 1000.0), "width and height of the wall that the image shows [m]"),
    optional("look.wall.roughness", Number(0.0, 1.0), "of the clean wall; left out: the material's", "0.85"),
    key("look.wall.total_passes", Number(1.0, 1e9), "how many people have passed since it was painted or washed"),
    key("look.wall.every_touch", Number(0.0, 20.0), "factor on simulated touches as they are: the paper's way"),
    key("look.wall.skin.strength", Number(0.0, 20.0), "factor on the touches of hands"),
    key("look.wall.skin.density", Number(0.0, 3.0), "optical density where the wall takes up no more of it"),
    key("look.wall.skin.spread_m", Number(0.005, 0.5), "how far simulated touches are evened out, for those beside them [m]"),
    key("look.wall.skin.colour", Any, "sRGB"),
    key("look.wall.cloth.strength", Number(0.0, 20.0), "factor on the touches of arms and shoulders"),
    key("look.wall.cloth.density", Number(0.0, 3.0), "optical density where the wall takes up no more of it"),
    key("look.wall.cloth.spread_m", Number(0.005, 0.5), "how far simulated touches are evened out, for those beside them [m]"),
    key("look.wall.cloth.colour", Any, "sRGB"),
    key("look.wall.bag.strength", Number(0.0, 20.0), "factor on the touches of bags, cases, trolleys"),
    key("look.wall.bag.density", Number(0.0, 3.0), "optical density where the wall takes up no more of it"),
    key("look.wall.bag.spread_m", Number(0.005, 0.5), "how far simulated touches are evened out, for those beside them [m]"),
    key("look.wall.bag.colour", Any, "sRGB"),
    key("look.wall.rubber.strength", Number(0.0, 20.0), "factor on the touches of shoes"),
    key("look.wall.rubber.density", Number(0.0, 3.0), "optical density where the wall takes up no more of it"),
    key("look.wall.rubber.spread_m", Number(0.005, 0.5), "how far simulated touches are evened out, for those beside them [m]"),
    key("look.wall.rubber.colour", Any, "sRGB"),
    key("look.wall.splash.density", Number(0.0, 3.0), "optical density that mopping leaves at the foot of the wall"),
    key("look.wall.splash.height_m", Number(0.01, 1.0), "where the splash band ends at the highest [m]"),
    key("look.wall.splash.unevenness", Number(0.0, 1.5), "how uneven it is"),
    key("look.wall.splash.drips_per_metre", Number(0.0, 20.0), "drips that ran down"),
    key("look.wall.splash.colour", Any, "sRGB"),
    key("look.wall.dust.density", Number(0.0, 3.0), "optical density of dust at the foot of the wall"),
    key("look.wall.dust.reach_m", Number(0.02, 3.0), "falls to 1/e in this height [m]"),
    key("look.wall.dust.hands", Number(0.0, 3.0), "optical density of a film at hand height along all walls"),
    key("look.wall.dust.colour", Any, "sRGB"),
    key("look.wall.skirting.height_m", Number(0.0, 0.5), "of a skirting board; 0: none [m]"),
    key("look.wall.skirting.colour", Any, "sRGB"),
    key("look.wall.noise.fine", Any, "unevenness of the dirt on walls: size of a spot [m], deviation of the logarithm"),
    key("look.wall.noise.middle", Any, "blotches"),
    key("look.wall.noise.coarse", Any, "clouds"),

    optional("patterns.folder", Any, "own patterns with their patterns.toml, relative to this file; left out: built in", "\"patterns\""),

    optional("route.name", Any, "what to call it", "\"west to north\""),
    optional("route.from", Any, "an opening's name, [x, y] in metres, { px = [x, y] }, or an area [[x0, y0], [x1, y1]]", "\"west\""),
    optional("route.to", Any, "as from", "\"north\""),
    optional("route.via", Any, "places to pass (each as from) and stops, in order; of a stop its name, or which share stops there",
        "[\"ticket office\", { stop = \"bench\", share = 0.2 }]"),
    optional("route.share", Number(1e-6, 1e6), "how many take it, relative to the other routes", "1.0"),
    optional("route.arrivals", Any, "when its people come, as [crowd.arrivals]; left out: as all others",
        "{ kind = \"bursts\", every_s = 360, people = 120, spread_s = 45 }"),

    optional("stop.name", Any, "what routes call it in `via`", "\"ticket office\""),
    optional("stop.kind", Any, "\"place\" to stand at, \"queue\" before a counter, \"machine\", \"bench\", or ticket \"gate\"", "\"queue\""),
    optional("stop.at", Any, "where people stand: a point, or a line [[x0, y0], [x1, y1]] of places; of a \"place\" two corners",
        "[12.0, 4.5]"),
    optional("stop.facing", Any, "a point that they face; left out: the nearest wall, from a bench away from it", "[12.0, 3.0]"),
    optional("stop.heading_deg", Number(-360.0, 360.0), "or the direction that they face [degrees from +x]", "-90.0"),
    optional("stop.dwell", Spread(0.0, 86400.0), "how long one stays or is served [s]; left out: by the kind",
        "{ mean = 30, sd = 15, min = 5, max = 120 }"),
    optional("stop.places", Number(1.0, 1000.0), "counters, seats or lanes side by side", "2"),
    optional("stop.spacing", Number(0.4, 5.0), "from one to the next in the line, on the bench, or around a place [m]", "0.75"),
    optional("stop.reach", Number(0.3, 50.0), "how far around the point of a \"place\" people stand [m]", "1.5"),
    optional("stop.queue", Any, "the line in which people queue, from the counter on; left out: straight back, along walls",
        "[[12.0, 5.5], [12.0, 11.0]]"),

    optional("door.name", Any, "what to call it", "\"office\""),
    optional("door.at", Any, "its middle, [x, y] in metres or { px = [x, y] }; where walls leave a gap, this says more of that door", "[12.0, 4.5]"),
    optional("door.width", Number(0.5, 6.0), "clear width [m]", "0.9"),
    optional("door.height", Number(1.8, 3.5), "height [m]", "2.1"),
    optional("door.hinge", Any, "a point near the jamb on which the leaf hangs: the handle is at the other; left out: either", "[12.4, 4.5]"),
    optional("door.handle", Number(0.6, 1.5), "height of the handle [m]", "1.0"),

    optional("fixture.name", Any, "what to call it", "\"light switch\""),
    optional("fixture.kind", Any, "\"switch\", \"handle\", \"counter\", \"bench\", \"radiator\", \"bin\", \"machine\" or \"chairs\"", "\"switch\""),
    optional("fixture.at", Any, "where it is at a wall: its middle, or its two ends [[x0, y0], [x1, y1]]", "[12.8, 4.4]"),
    optional("fixture.facing", Any, "a point on the side from which it is reached: of a thin wall, it chooses the face", "[12.8, 6.0]"),
    optional("fixture.width", Number(0.02, 20.0), "width along the wall [m]; left out: by the kind", "0.1"),

    optional("unit.name", Any, "what the report calls the spot", "\"kiosk\""),
    optional("unit.at", Any, "where the viewer stands: [x, y] in metres or { px = [x, y] }", "[12.0, 4.5]"),
    optional("unit.facing", Any, "a point that the viewer looks at", "[12.0, 9.0]"),
    optional("unit.heading_deg", Number(-360.0, 360.0), "or the direction [degrees counter-clockwise from +x]", "90.0"),
    optional("unit.folder", Any, "a folder with own units, relative to this file; left out: the built-in ones", "\"units\""),
    optional("unit.every", Number(0.05, 60.0), "how often the people there are looked at [s]", "0.2"),
    optional("unit.pause", Number(0.0, 3600.0), "how long those who have played are left alone [s]", "1.0"),
    optional("unit.front", Number(0.5, 20.0), "width and depth of the area in front in which people are counted [m]", "[3.0, 3.0]"),
    optional("unit.rear", Number(0.0, 20.0), "the same behind the viewer [m]", "[3.0, 3.0]"),
    optional("unit.area", Number(1.0, 40.0), "width and depth of the area in front in which units are played [m]", "[3.0, 7.0]"),
    optional("unit.radius", Number(0.0, 2.0), "of the viewer's body, which people walk around [m]; 0: nobody stands there", "0.25"),
    optional("unit.play", Any, "whether units are played; if not, people there are only measured", "true"),

    optional("formation.duration_s", Number(0.1, 36000.0), "how long it lasts [s]; left out: to the last key formation", "60.0"),
    optional("formation.fps", Number(0.1, 1000.0), "frames per second; left out: 10", "10.0"),
    optional("formation.fluctuation", Number(0.0, 10.0), "how strongly the example's own way of moving is kept; left out: 1", "1.0"),
    optional("formation.stays_with", Any, "what that stays with: \"shapes\" that the formation is made of, or \"people\"", "\"people\""),
    optional("formation.sigma_m", Number(1e-3, 1e4), "how far neighbours feel each other [m]; left out: from how far apart they are", "1.2"),
    optional("formation.together", Any, "who keeps together wherever they are; people count from 0 in the order of the example", "[[0, 1, 3]]"),
    optional("formation.adjacency", Any, "or how near they feel, from 0, strangers, to 1, as if in one place", "[{ members = [0, 1], weight = 0.2 }]"),
    optional("formation.assign", Any, "who goes where in a key formation: \"shortest\" ways for all together, or by \"order\" (always in the first of those who only stand)", "\"shortest\""),
    optional("formation.pace", Any, "from key to key: \"gentle\" starts and stops, or \"even\"", "\"gentle\""),
    optional("formation.example.kind", Any, "what the example does: \"still\", \"sway\", \"ranks\" that march, or \"wander\"", "\"ranks\""),
    optional("formation.example.file", Any, "or a recording, relative to this file", "\"march.txt\""),
    optional("formation.example.recording", Any, "how the recording is read, as [motion]", "{ unit = \"cm\", fps = 16 }"),
    optional("formation.example.from_s", Number(0.0, 1e7), "where in it to begin [s]", "2.0"),
    optional("formation.example.to_s", Number(0.0, 1e7), "where to end [s]; left out: at its end", "20.0"),
    optional("formation.example.repeat", Any, "how it goes on if it is too short: \"to-and-fro\" or \"loop\"", "\"loop\""),
    optional("formation.example.choose", Any, "which of its people; of small crowds a list for each", "[[0, 1, 3], [4, 5, 7]]"),
    optional("formation.example.people", Number(1.0, 2000.0), "how many are made; left out: by rows and columns, or as a key formation has points", "9"),
    optional("formation.example.rows", Number(1.0, 2000.0), "rows one behind the other", "3"),
    optional("formation.example.columns", Number(1.0, 2000.0), "people side by side", "3"),
    optional("formation.example.spacing_m", Number(0.05, 1e3), "from one to the next [m]", "1.0"),
    optional("formation.example.speed_m_s", Number(0.0, 10.0), "how fast they walk [m/s]; left out: ranks 1.2, who wanders 0.9", "1.2"),
    optional("formation.example.heading_deg", Number(-360.0, 360.0), "where ranks go [degrees from +x]", "90.0"),
    optional("formation.example.stray_m", Number(0.0, 10.0), "how far everybody strays from their place in the ranks [m]", "0.12"),
    optional("formation.example.radius_m", Number(0.1, 1e4), "how far from their middle people wander [m]; left out: by the spacing", "6.0"),
    optional("formation.example.seed", Any, "another number, another example", "1"),
    optional("formation.way.from", Any, "where the middle of all begins [m]; key formations are placed relative to it", "[0.0, 0.0]"),
    optional("formation.way.to", Any, "where it ends [m]", "[20.0, 0.0]"),
    optional("formation.way.path", Any, "points on the way [m], on a smooth curve", "[[5.0, 3.0], [12.0, -3.0]]"),
    optional("formation.way.from_s", Number(0.0, 36000.0), "when it begins [s]", "5.0"),
    optional("formation.way.to_s", Number(0.0, 36000.0), "when it ends [s]; left out: at the end of all", "50.0"),
    optional("formation.way.follow_heading", Any, "whether all turn along it: what is up in a formation points forward", "true"),
    optional("formation.avoid.on", Any, "whether people keep clear of each other", "true"),
    optional("formation.avoid.distance_m", Number(0.0, 10.0), "bodies' middles never come nearer to each other [m]; left out: 0.36", "0.36"),
    optional("formation.avoid.push", Number(0.0, 1.0), "how strongly neighbours push each other; left out: 0.02", "0.02"),
    optional("formation.avoid.seconds", Number(0.1, 10.0), "how long before and after people step aside [s]; left out: 0.8", "0.8"),
    optional("formation.key.time_s", Number(0.0, 36000.0), "when people stand so [s]", "20.0"),
    optional("formation.key.hold_s", Number(0.0, 36000.0), "how long they stay in it [s]", "3.0"),
    optional("formation.key.shape", Any, "\"example\" (as there), \"grid\", \"line\", \"ring\", \"disc\", \"triangle\", \"polygon\", \"star\" or \"wedge\"; up is forward", "\"star\""),
    optional("formation.key.text", Any, "or letters that people stand along", "\"HELLO\""),
    optional("formation.key.points", Any, "or a place for each [m]", "[[0.0, 0.0], [1.0, 0.0], [0.5, 0.9]]"),
    optional("formation.key.file", Any, "or a picture of dots, or a text of points; relative to this file", "\"dots.png\""),
    optional("formation.key.metres_per_pixel", Number(0.0005, 10.0), "of the picture [m]; left out: 0.1", "0.1"),
    optional("formation.key.filled", Any, "whether people fill what is drawn, a polygon or a star evenly", "true"),
    optional("formation.key.columns", Number(1.0, 2000.0), "people side by side in a grid", "6"),
    optional("formation.key.rings", Number(1.0, 100.0), "rings one in the other", "2"),
    optional("formation.key.corners", Number(3.0, 100.0), "of a polygon; points of a star", "5"),
    optional("formation.key.inner", Number(0.05, 1.0), "inner radius of a star over its outer", "0.45"),
    optional("formation.key.angle_deg", Number(0.0, 360.0), "between the two lines of a wedge [degrees]", "80.0"),
    optional("formation.key.spacing_m", Number(0.05, 1e3), "from one to the next [m]", "1.0"),
    optional("formation.key.radius_m", Number(0.01, 1e4), "of rings, discs, polygons, stars [m]; left out: by the spacing", "4.0"),
    optional("formation.key.height_m", Number(0.1, 1e4), "of letters [m]; left out: by the spacing", "5.0"),
    optional("formation.key.at", Any, "where its middle is [m]", "[10.0, 0.0]"),
    optional("formation.key.turn_deg", Number(-3600.0, 3600.0), "how far it is turned, counter-clockwise [degrees]", "45.0"),
    optional("formation.key.wheel_deg", Number(-3600.0, 3600.0), "how far all wheel as one body on the way to it [degrees]", "180.0"),
    optional("formation.key.scale", Number(1e-3, 1e3), "how many times as large", "1.5"),
    optional("formation.key.assign", Any, "who goes where in this one, as above", "\"order\""),
    optional("formation.crowd.members", Any, "in whose places small crowds stand: \"all\", a list, or { every = 2, from = 0 }", "[0, 2, 4]"),
    optional("formation.crowd.rider", Any, "whether one more is carried in the middle of each", "true"),
    optional("formation.crowd.as_one", Any, "whether each keeps clear of others as one body; left out: with a rider", "true"),
    optional("formation.crowd.follow_heading", Any, "whether each turns to where it goes", "true"),
    optional("formation.crowd.example", Any, "how its people move, as [formation.example]", "{ kind = \"sway\", people = 3 }"),
    optional("formation.crowd.fluctuation", Number(0.0, 10.0), "as in [formation]", "1.0"),
    optional("formation.crowd.stays_with", Any, "as in [formation]", "\"people\""),
    optional("formation.crowd.sigma_m", Number(1e-3, 1e4), "as in [formation]", "0.8"),
    optional("formation.crowd.together", Any, "as in [formation]", "[[0, 1]]"),
    optional("formation.crowd.adjacency", Any, "as in [formation]", "[{ members = [0, 1], weight = 0.2 }]"),
    optional("formation.crowd.assign", Any, "as in [formation]", "\"order\""),
    optional("formation.crowd.pace", Any, "as in [formation]", "\"even\""),
    optional("formation.crowd.avoid", Any, "as [formation.avoid]; what is left out is as in the larger crowd", "{ distance_m = 0.3 }"),
    optional("formation.crowd.key", Any, "its formations, each in a [[formation.crowd.key]]", "[{ time_s = 0, shape = \"triangle\" }]"),
    optional("formation.crowd.crowd", Any, "smaller crowds within, each in a [[formation.crowd.crowd]]", "[]"),
];
