//! How people's feet come down, measured on the footfalls themselves and held against what was measured on people:
//! step length over speed, step width, toe-out, what standing, turning, stepping aside and swaying make of them.

mod crowd;
mod measure;
mod queue;
mod recorded;
mod scuffs;
mod strides;

use measure::{Floor, Path, Step, by_speed, measured_step_m, spread, steps};
use trodden::marks::Mark;
use trodden::math::{Vec2, sin_cos, vec2};

const TAU: f64 = std::f64::consts::TAU;

/// Somebody who walks straight on at a speed, without sway.
fn straight(id: u32, speed_m_s: f64, way_m: f64) -> Path {
    Path::of(id, way_m / speed_m_s, 10.0, move |t| vec2(10.0 + speed_m_s * t, 50.0 + 0.5 * f64::from(id % 100)))
}

/// Unit vector in a direction.
pub fn direction(angle_rad: f64) -> Vec2 {
    let (s, c) = sin_cos(angle_rad);
    vec2(c, s)
}

/// Angle from one direction to another, degrees.
pub fn between_deg(from: Vec2, to: Vec2) -> f64 {
    trodden::math::atan2(from.cross(to), from.dot(to)).to_degrees()
}

fn walked(floor: &Floor, people: u32, path: impl Fn(u32) -> Path) -> Vec<Step> {
    let steps_of = |id| {
        let path = path(id);
        steps(&path, &floor.feet(&path))
    };
    (0..people).flat_map(steps_of).collect()
}

#[test]
fn steps_are_as_long_as_measured_at_every_speed() {
    let floor = Floor::hall();
    let mut all = Vec::new();
    for n in 0..14 {
        let speed = 0.4 + 0.1 * f64::from(n);
        let seen = walked(&floor, 60, |id| straight(id, speed, 25.0));
        let [length, _] = spread(seen.iter().map(|step| step.length_m));
        let law = measured_step_m(speed);
        assert!((length / law - 1.0).abs() < 0.1, "{length:.3} m at {speed:.2} m/s, measured {law:.3}");
        all.extend(seen);
    }
    by_speed("straight on", &all, 0.2);
}

#[test]
fn tall_people_take_longer_steps() {
    let floor = Floor::hall();
    let mean = |id| spread(walked(&floor, 1, |_| straight(id, 1.34, 25.0)).iter().map(|step| step.length_m))[0];
    let grown: Vec<u32> = (0..200).filter(|&id| !floor.people.person(id).child).collect();
    let lengths: Vec<[f64; 2]> = grown.iter().map(|&id| [floor.people.person(id).stature_m, mean(id)]).collect();
    let [stature, stature_sd] = spread(lengths.iter().map(|row| row[0]));
    let [length, length_sd] = spread(lengths.iter().map(|row| row[1]));
    let both = lengths.iter().map(|row| (row[0] - stature) * (row[1] - length)).sum::<f64>() / lengths.len() as f64;
    let correlation = both / (stature_sd * length_sd);
    println!("step {length:.3} +- {length_sd:.3} m, correlation with stature {correlation:.2}");
    // Murray 1964, 1970: 79 and 66 cm by men and women who differ by 13 cm in stature; 5 to 6 cm within a sex.
    assert!((0.04..0.08).contains(&length_sd), "{length_sd}");
    assert!((0.5..0.95).contains(&correlation), "{correlation}");
}

#[test]
fn shuffling_feet_take_shorter_steps_not_fewer() {
    let floor = Floor::hall();
    let of_speed = |speed: f64| {
        let seen = walked(&floor, 40, |id| straight(id, speed, 6.0));
        let along = |step: &Step| (step.length_m * step.length_m - step.width_m * step.width_m).max(0.0).sqrt();
        spread(seen.iter().map(along))[0]
    };
    let rows = [0.15, 0.2, 0.3, 0.4].map(|speed| (speed, of_speed(speed), speed / of_speed(speed)));
    for (speed, length, hertz) in rows {
        println!("{speed} m/s: {length:.3} m, {hertz:.2} steps/s");
        assert!((hertz / rows[3].2 - 1.0).abs() < 0.15, "{hertz:.2} steps per second at {speed} m/s");
    }
}

#[test]
fn feet_are_as_far_apart_and_point_as_far_outward_as_measured() {
    let floor = Floor::hall();
    let people = 400;
    let own = |men: bool, value: fn(&Step) -> f64| {
        let of_sex = |id: &u32| {
            let person = floor.people.person(*id);
            // Shoulders are 0.291 of a man's stature and 0.277 of a woman's.
            !person.child && (person.shoulder_width_m / person.stature_m > 0.285) == men
        };
        let walk = |id| walked(&floor, 1, |_| straight(id, 1.34, 15.0));
        let all: Vec<f64> = (0..people).filter(of_sex).flat_map(walk).map(|step| value(&step)).collect();
        (spread(all.iter().copied()), all)
    };
    for (men, width_cm, toe_deg) in [(true, 8.1, 7.0), (false, 7.1, 6.0)] {
        let ([width, _], _) = own(men, |step| 100.0 * step.width_m);
        let ([toe, _], all) = own(men, |step| step.toe_out_rad.to_degrees());
        let usual = all.iter().filter(|deg| (5.0..10.0).contains(*deg)).count() as f64 / all.len() as f64;
        println!("men {men}: width {width:.1} cm, toe-out {toe:.1} degrees, {:.0} % from 5 to 10", 100.0 * usual);
        assert!((width - width_cm).abs() < 0.6, "{width} cm instead of {width_cm}");
        assert!((toe - toe_deg).abs() < 0.7, "{toe} degrees instead of {toe_deg}");
        assert!(usual > 0.5, "{usual} of the feet");
    }
    let of_one = walked(&floor, 1, |_| straight(3, 1.34, 60.0));
    let [_, toe_sd] = spread(of_one.iter().map(|step| step.toe_out_rad.to_degrees()));
    assert!((1.0..5.0).contains(&toe_sd), "from step to step {toe_sd} degrees");
}

#[test]
fn slow_feet_are_farther_apart() {
    let floor = Floor::hall();
    let width = |speed| spread(walked(&floor, 60, |id| straight(id, speed, 15.0)).iter().map(|step| step.width_m))[0];
    let (slow, free) = (width(0.4), width(1.34));
    println!("width {slow:.3} m at 0.4 m/s, {free:.3} at 1.34");
    assert!(slow > 1.2 * free && slow < 1.8 * free, "{slow} m at 0.4 m/s, {free} at 1.34");
    // On a circle of 1.5 m.
    let round = |id: u32| {
        Path::of(id, 30.0, 10.0, |t| {
            let angle = 1.0 / 1.5 * t;
            vec2(50.0, 50.0) + direction(angle) * 1.5
        })
    };
    let straight_on = width(1.0);
    let feet: Vec<f64> = (0..60)
        .flat_map(|id| {
            let feet = floor.feet(&round(id));
            let off = |mark: &Mark| {
                let side = if mark.mirrored { 1.0 } else { -1.0 };
                2.0 * side * (mark.place_m.distance(vec2(50.0, 50.0)) - 1.5)
            };
            feet.iter().map(off).collect::<Vec<f64>>()
        })
        .collect();
    let [turning, _] = spread(feet);
    println!("width {turning:.3} m on a circle, {straight_on:.3} straight on at 1 m/s");
    assert!(turning > 1.15 * straight_on && turning < straight_on + 0.06, "{turning}, {straight_on}");
}

/// The sway of a recorded head and the jitter of its detection.
fn swaying(id: u32, speed: f64, amplitude: f64, hertz: f64) -> Path {
    // People's strides differ.
    let stride_hz = 0.5 * speed / measured_step_m(speed) * (0.88 + 0.24 * (f64::from(id) * 0.618_034).fract());
    let noise = move |t: f64, k: f64| sin_cos(1e4 * sin_cos(12.9898 * t + 78.233 * k + f64::from(id)).0).0;
    Path::of(id, 20.0 / speed, hertz, move |t| {
        let sway = amplitude * sin_cos(TAU * stride_hz * t + f64::from(id)).0;
        let surge = 0.25 * amplitude * sin_cos(2.0 * TAU * stride_hz * t).0;
        vec2(10.0 + speed * t + surge + 0.01 * noise(t, 1.0), 50.0 + sway + 0.01 * noise(t, 2.0))
    })
}

#[test]
fn sway_and_jitter_do_not_become_zig_zag_feet() {
    let floor = Floor::hall();
    for (speed, amplitude) in [(1.6, 0.03), (1.34, 0.03), (0.9, 0.04), (0.6, 0.06), (0.4, 0.07)] {
        let calm = walked(&floor, 25, |id| straight(id, speed, 20.0));
        let width = |seen: &[Step]| spread(seen.iter().map(|step| step.width_m));
        let toe = |seen: &[Step]| spread(seen.iter().map(|step| step.toe_out_rad.to_degrees()));
        for hertz in [16.0, 25.0, 60.0] {
            let feet = |id| {
                let path = swaying(id, speed, amplitude, hertz);
                // Angles are measured against the straight way.
                let even = straight(id, speed, 20.0);
                let feet = floor.feet(&path);
                steps(
                    &even,
                    &feet.iter().map(|foot| shifted(foot, even.at[0].1.position_m.y - 50.0)).collect::<Vec<_>>(),
                )
            };
            let seen: Vec<Step> = (0..25).flat_map(feet).collect();
            let ([length, _], law) = (spread(seen.iter().map(|step| step.length_m)), measured_step_m(speed));
            let ([w, w_sd], [t, t_sd]) = (width(&seen), toe(&seen));
            println!(
                "{speed} m/s, {hertz} Hz: step {:.2} of the law, width {:.1} +- {:.1} cm (calm {:.1} +- {:.1}), \
                 toe-out {t:.1} +- {t_sd:.1} (calm {:.1} +- {:.1})",
                length / law,
                100.0 * w,
                100.0 * w_sd,
                100.0 * width(&calm)[0],
                100.0 * width(&calm)[1],
                toe(&calm)[0],
                toe(&calm)[1]
            );
            assert!((length / law - 1.0).abs() < 0.1);
            assert!((w - width(&calm)[0]).abs() < 0.01 && w_sd < width(&calm)[1] + 0.012);
            assert!((t - toe(&calm)[0]).abs() < 0.6 && t_sd < toe(&calm)[1] + 1.5);
        }
    }
}

fn shifted(foot: &Mark, y_m: f64) -> Mark {
    Mark { place_m: foot.place_m + vec2(0.0, y_m), ..*foot }
}

#[test]
fn who_shuffles_forward_ends_with_feet_side_by_side() {
    let floor = Floor {
        options: trodden::marks::MarksOptions { shifts_per_minute: 0.0, ..Floor::hall().options },
        ..Floor::hall()
    };
    for shuffle_m in [0.2, 0.3, 0.45, 0.6] {
        let mut prints = Vec::new();
        for id in 0..40 {
            // Ten shuffles, each within a second and a half, eight seconds apart.
            let way = |t: f64| {
                let (count, since) = ((t / 8.0).floor(), t % 8.0);
                let share = (since / 1.5).min(1.0);
                shuffle_m * (count.min(10.0) + if count < 10.0 { share * share * (3.0 - 2.0 * share) } else { 0.0 })
            };
            let path = Path::of(id, 88.0, 10.0, |t| vec2(50.0 + way(t), 50.0)).facing(|_| vec2(1.0, 0.0));
            let feet = floor.feet(&path);
            for foot in feet.windows(2) {
                assert!(foot[1].place_m.x > foot[0].place_m.x - 0.12, "a step back");
                assert!(between_deg(vec2(1.0, 0.0), foot[1].heading).abs() < 25.0);
            }
            let last = |right: bool| feet.iter().rfind(|foot| foot.mirrored == right).unwrap().place_m;
            let (left, right) = (last(false), last(true));
            assert!((left.x - right.x).abs() < 0.13, "feet {:.2} m behind each other", left.x - right.x);
            assert!((0.08..0.3).contains(&(left.y - right.y)), "feet {:.2} m apart", left.y - right.y);
            let body = 50.0 + way(88.0);
            assert!((0.5 * (left.x + right.x) - body).abs() < 0.14, "the body is {:.2} m off", body - left.x);
            prints.push((feet.len() - 2) as f64 / 10.0);
        }
        let [mean, _] = spread(prints);
        println!("shuffles of {shuffle_m} m: {mean:.2} prints each");
        assert!((1.8..3.4).contains(&mean), "{mean} prints per shuffle of {shuffle_m} m");
    }
}

#[test]
fn who_stands_shifts_the_weight_now_and_then() {
    let floor = Floor::hall();
    let stand = |id: u32, seconds: f64, hertz: f64| {
        let sway = move |t: f64| vec2(0.03 * sin_cos(1.1 * t + f64::from(id)).0, 0.02 * sin_cos(0.7 * t).0);
        Path::of(id, seconds, hertz, move |t| vec2(50.0, 50.0) + sway(t)).facing(|_| vec2(0.0, 1.0))
    };
    let feet = |seconds: f64, hertz: f64| {
        (0..200).map(|id| floor.feet(&stand(id, seconds, hertz)).len() as f64 - 2.0).sum::<f64>() / 200.0
    };
    let (one, five) = (feet(60.0, 10.0), feet(300.0, 10.0));
    println!("{one:.2} prints in a minute, {five:.2} in five");
    assert!((1.5..5.0).contains(&one), "{one} prints a minute");
    assert!((five / one / 5.0 - 1.0).abs() < 0.15, "{five} in five minutes, {one} in one");
    // Prints are varied: not all in one place and direction.
    let all: Vec<Mark> = (0..200).flat_map(|id| floor.feet(&stand(id, 300.0, 10.0))).collect();
    let [_, turn_sd] = spread(all.iter().map(|foot| between_deg(vec2(0.0, 1.0), foot.heading)));
    let [_, along_sd] = spread(all.iter().map(|foot| foot.place_m.y));
    println!("headings +- {turn_sd:.1} degrees, places +- {:.1} cm", 100.0 * along_sd);
    assert!((8.0..20.0).contains(&turn_sd) && (0.03..0.09).contains(&along_sd));
    for hertz in [5.0, 20.0, 50.0] {
        assert!((feet(300.0, hertz) / five - 1.0).abs() < 0.03, "{hertz} Hz");
    }
}

#[test]
fn a_body_that_turns_on_the_spot_turns_its_feet() {
    let floor = Floor::hall();
    let turn = |id: u32| {
        let angle = |t: f64| (1.5 * (t - 5.0)).clamp(0.0, std::f64::consts::PI);
        Path::of(id, 15.0, 10.0, |_| vec2(50.0, 50.0)).facing(move |t| direction(angle(t)))
    };
    let mut counts = Vec::new();
    for id in 0..60 {
        let feet = floor.feet(&turn(id));
        assert!(feet.iter().all(|foot| foot.place_m.distance(vec2(50.0, 50.0)) < 0.3));
        let last = |right: bool| feet.iter().rfind(|foot| foot.mirrored == right).unwrap();
        for right in [false, true] {
            let off = between_deg(vec2(-1.0, 0.0), last(right).heading).abs();
            assert!(off < 45.0, "a foot points {off:.0} degrees away from the body");
        }
        counts.push(feet.len() as f64);
    }
    let [prints, _] = spread(counts);
    println!("{prints:.1} prints of a half turn, the first two included");
    assert!((5.0..9.0).contains(&prints), "{prints}");
}

#[test]
fn steps_back_and_aside_flip_no_feet() {
    let floor = Floor::hall();
    let ahead = vec2(1.0, 0.0);
    let pushed = |way: Vec2| {
        move |t: f64| {
            let share = ((t - 4.0) / 1.0).clamp(0.0, 1.0);
            vec2(50.0, 50.0) + way * (share * share * (3.0 - 2.0 * share))
        }
    };
    for way in [vec2(-0.35, 0.0), vec2(0.0, 0.35), vec2(0.0, -0.35), vec2(-0.8, 0.0), vec2(0.0, 0.8)] {
        for id in 0..40 {
            let path = Path::of(id, 10.0, 10.0, pushed(way)).facing(|_| ahead);
            let feet = floor.feet(&path);
            assert!(feet.len() >= 4, "{} prints: the push left none", feet.len());
            assert!(feet.iter().all(|foot| between_deg(ahead, foot.heading).abs() < 45.0), "a foot turned");
            // Feet do not cross: every left foot stays to the left of the right one beside it.
            for pair in feet.windows(2) {
                let left_of = |foot: &Mark| if foot.mirrored { -foot.place_m.y } else { foot.place_m.y };
                assert!(
                    pair[0].mirrored == pair[1].mirrored || left_of(&pair[0]) + left_of(&pair[1]) > 0.0,
                    "crossed: {way:?} person {id}: {pair:?}"
                );
            }
        }
    }
    // The same where nobody knows the heading: half a step back after walking up.
    let recorded = |t: f64| vec2(50.0 + 1.2 * t.min(4.0) - 0.35 * ((t - 6.0) / 1.0).clamp(0.0, 1.0), 50.0);
    for id in 0..40 {
        let feet = floor.feet(&Path::of(id, 10.0, 25.0, recorded));
        assert!(feet.iter().all(|foot| between_deg(ahead, foot.heading).abs() < 45.0), "a foot turned");
    }
}

#[test]
fn feet_point_where_the_body_faces() {
    let floor = Floor::hall();
    // Walking along x while looking 25 degrees to the left.
    let facing = direction(25f64.to_radians());
    let path = |id| straight(id, 1.0, 20.0).facing(move |_| facing);
    let feet: Vec<Mark> = (0..40).flat_map(|id| floor.feet(&path(id))).collect();
    let [mean, sd] = spread(feet.iter().map(|foot| between_deg(facing, foot.heading)));
    println!("{mean:.1} +- {sd:.1} degrees off the body's heading");
    assert!(mean.abs() < 1.0 && sd < 9.5, "{mean} +- {sd}");
}
