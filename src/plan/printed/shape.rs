//! The shape of a glyph: the middle lines of its strokes, compared with letters drawn as strokes. Thus fonts that are
//! thin, bold, with or without serifs are alike.

/// Least height at which a glyph's strokes are thinned, pixels: smaller ones are enlarged.
const THINNED_PX: usize = 30;
/// Shares of a glyph's greatest darkness from which a pixel belongs to its strokes. What is a letter at two of them, and
/// no other at the third, is that letter: blurred strokes break at one and close at another.
const STROKES: [f32; 3] = [0.42, 0.3, 0.55];
/// Least area of a hole, as a share of the glyph's box.
const LEAST_HOLE: f32 = 0.004;
/// Width of all glyphs in heights; those narrower than `NARROW` heights stay narrow.
const WIDTH: f32 = 0.62;
const NARROW: f32 = 0.33;
/// Number of points of a shape that are compared, and of those at once.
const POINTS: usize = 40;
const LANES: usize = 8;
/// What a hole more or less counts, in heights.
const HOLE: f32 = 0.05;
/// Greatest distance of a glyph from its letter in heights, and how much nearer that is than any other.
const NEAR: f32 = 0.085;
const NEARER: f32 = 1.25;
/// Greatest distance of a glyph from a letter that it may be, even if it is like others too.
const ABOUT: f32 = 0.13;

/// How far letters lean, as a share of their height: upright and sloped lettering.
const LEANS: [f32; 2] = [0.0, 0.22];
/// Letters and their strokes on a grid 6 wide and 9 high: points as pairs of digits, strokes apart by a slash.
const LETTERS: [(char, &str); 46] = [
    ('0', "30 11 03 06 18 39 58 66 63 51 30"),
    ('0', "10 01 08 19 59 68 61 50 10"),
    ('0', "30 11 03 06 18 39 58 66 63 51 30/34 35"),
    ('0', "30 11 03 06 18 39 58 66 63 51 30/08 61"),
    ('1', "03 30 39"),
    ('1', "02 12 30 39"),
    ('1', "02 20 29/09 49"),
    ('1', "01 20 29/09 49"),
    ('2', "02 11 30 51 62 63 54 36 09 69"),
    ('2', "01 10 50 62 63 09 69"),
    ('2', "02 01 10 50 61 63 54 14 05 09 69"),
    ('3', "02 10 40 51 62 53 34 24 34 55 66 67 58 39 19 07"),
    ('3', "01 10 50 61 63 54 24 54 65 68 59 19 08"),
    ('3', "00 60 23 34 54 65 67 58 39 19 07"),
    ('4', "49 40 06 66"),
    ('4', "59 50 06 66"),
    ('4', "10 06 66/43 49"),
    ('5', "60 10 04 13 43 55 66 67 58 39 19 07"),
    ('5', "60 00 03 14 44 56 67 59 19 07"),
    ('5', "60 00 04 54 65 68 59 09"),
    ('6', "51 30 11 03 06 18 39 58 67 66 55 34 15 06"),
    ('6', "50 30 02 07 19 49 67 66 44 24 06"),
    ('6', "40 14 06 18 39 58 66 55 34 15"),
    ('6', "61 50 10 01 08 19 59 68 65 54 04"),
    ('7', "00 60 29"),
    ('7', "00 60 43 29"),
    ('7', "01 00 60 29"),
    ('8', "30 11 12 13 34 53 52 51 30 34 15 06 07 18 39 58 67 66 55 34"),
    ('8', "10 01 03 14 54 63 61 50 10 14 05 08 19 59 68 65 54"),
    ('9', "18 39 58 66 63 51 30 11 02 03 14 35 54 63"),
    ('9', "19 39 67 62 50 20 02 03 25 45 63"),
    ('9', "29 55 63 51 30 11 03 14 35 54"),
    ('9', "08 19 59 68 61 50 10 01 04 15 65"),
    ('M', "09 00 35 60 69"),
    ('M', "09 00 39 60 69"),
    ('x', "00 69/60 09"),
    ('f', "50 31 22 29/03 43"),
    ('t', "10 17 29 49/03 43"),
    ('s', "61 40 20 02 03 14 55 66 67 49 29 08"),
    ('q', "69 60 61 40 20 02 04 26 46 65"),
    ('F', "09 00 60/04 44"),
    ('T', "00 60/30 39"),
    ('Q', "30 11 03 06 18 39 58 66 63 51 30/47 69"),
    ('Q', "30 11 03 06 18 39 58 66 63 51 30/36 69"),
    ('C', "62 41 20 02 07 29 49 67"),
    ('A', "09 30 69/16 56"),
];

/// The middle lines of a glyph's strokes in its box, heights of the glyph.
struct Shape {
    x: [f32; POINTS],
    y: [f32; POINTS],
    holes: usize,
}

/// All known letters.
pub(super) struct Alphabet(Vec<(char, Shape)>);

impl Alphabet {
    pub(super) fn new() -> Alphabet {
        let each = |&(letter, strokes)| LEANS.map(|lean| (letter, Shape::of_strokes(letter, strokes, lean)));
        Alphabet(LETTERS.iter().flat_map(each).collect())
    }

    /// The letter among some that a glyph is by the darkness of its pixels; `None` if it is like none or like two.
    pub(super) fn letter(&self, darkness: &[u8], width: usize, among: &str) -> Option<char> {
        let (mut found, mut count, mut unlike) = (None, 0, 0);
        for share in STROKES {
            match Shape::of(darkness, width, share).and_then(|shape| self.one(&shape, among)) {
                Some(letter) if found.is_none_or(|found| found == letter) => (found, count) = (Some(letter), count + 1),
                Some(_) => return None,
                None => unlike += 1,
            }
            if unlike > 1 {
                return None;
            }
        }
        found.filter(|_| count >= 2)
    }

    /// The letter among some that a glyph is most like.
    pub(super) fn likeliest(&self, darkness: &[u8], width: usize, among: &str) -> Option<char> {
        let shapes: Vec<Shape> = STROKES.iter().filter_map(|&share| Shape::of(darkness, width, share)).collect();
        let known = self.0.iter().filter(|(letter, _)| among.contains(*letter));
        let each =
            known.flat_map(|(letter, known)| shapes.iter().map(move |shape| (shape.apart(known, ABOUT), *letter)));
        each.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|best| best.0 <= ABOUT).map(|best| best.1)
    }

    fn one(&self, shape: &Shape, among: &str) -> Option<char> {
        let mut best = (f32::INFINITY, ' ');
        let mut second = f32::INFINITY;
        for (letter, known) in self.0.iter().filter(|(letter, _)| among.contains(*letter)) {
            let apart = shape.apart(known, NEAR * NEARER);
            if apart < best.0 {
                if best.1 != *letter {
                    second = best.0;
                }
                best = (apart, *letter);
            } else if *letter != best.1 {
                second = second.min(apart);
            }
        }
        (best.0 <= NEAR && second >= best.0 * NEARER).then_some(best.1)
    }
}

impl Shape {
    /// The shape of a letter whose strokes lean to the right by a share of their height.
    fn of_strokes(letter: char, strokes: &str, lean: f32) -> Shape {
        let place = |pair: &str| {
            let [x, y] = [0, 1].map(|k| f32::from(pair.as_bytes()[k] - b'0'));
            [x + (9.0 - y) * lean, y]
        };
        let mut points = Vec::new();
        for stroke in strokes.split('/') {
            let corners: Vec<[f32; 2]> = stroke.split(' ').map(place).collect();
            for pair in corners.windows(2) {
                let steps = (0..=12).map(|k| k as f32 / 12.0);
                points.extend(steps.map(|t| [0, 1].map(|k| pair[0][k] + (pair[1][k] - pair[0][k]) * t)));
            }
        }
        let holes = match letter {
            '8' => 2,
            '0' if strokes.ends_with("/08 61") => 2,
            '0' | '6' | '9' | 'Q' | 'q' | 'A' => 1,
            '4' if strokes.starts_with('4') || strokes.starts_with('5') => 1,
            _ => 0,
        };
        Shape::normal(points, holes)
    }

    /// The shape of a glyph from the darkness of its pixels, of which a share of the greatest belongs to strokes.
    fn of(darkness: &[u8], width: usize, share: f32) -> Option<Shape> {
        let (strokes, across) = enlarged(darkness, width, share);
        let holes = holes(&strokes, across);
        let thin = thinned(strokes, across);
        let points: Vec<[f32; 2]> = thin.iter().map(|at| [(at % across) as f32, (at / across) as f32]).collect();
        (points.len() >= THINNED_PX / 2).then(|| Shape::normal(points, holes))
    }

    /// Puts points into a box of height 1, and thins them out.
    fn normal(mut points: Vec<[f32; 2]>, holes: usize) -> Shape {
        let fold = |k: usize, pick: fn(f32, f32) -> f32| points.iter().map(|p| p[k]).reduce(pick).unwrap_or(0.0);
        let (low, high) = ([fold(0, f32::min), fold(1, f32::min)], [fold(0, f32::max), fold(1, f32::max)]);
        let height = (high[1] - low[1]).max(1.0);
        let aspect = (high[0] - low[0]) / height;
        let across = WIDTH / aspect.max(NARROW) / height;
        let middle = (low[0] + high[0]) * 0.5;
        points.iter_mut().for_each(|p| *p = [(p[0] - middle) * across, (p[1] - low[1]) / height]);
        let points = even(&points);
        Shape { x: points.map(|p| p[0]), y: points.map(|p| p[1]), holes }
    }

    /// How far apart two shapes are: the root of the mean squared distance of points to the other shape, heights. Infinite
    /// where holes alone are more than `most`.
    fn apart(&self, other: &Shape, most: f32) -> f32 {
        let holes = HOLE * self.holes.abs_diff(other.holes) as f32;
        if holes >= most {
            return f32::INFINITY;
        }
        let less = |a: f32, b: f32| if a < b { a } else { b };
        let mut nearest = [f32::INFINITY; POINTS];
        let mut sum = 0.0;
        for (x, y) in self.x.iter().zip(&self.y) {
            let mut least = [f32::INFINITY; LANES];
            for first in (0..POINTS).step_by(LANES) {
                for (k, least) in least.iter_mut().enumerate() {
                    let [dx, dy] = [x - other.x[first + k], y - other.y[first + k]];
                    let squared = dx * dx + dy * dy;
                    *least = less(*least, squared);
                    nearest[first + k] = less(nearest[first + k], squared);
                }
            }
            sum += least.into_iter().fold(f32::INFINITY, less);
        }
        let mean = (sum + nearest.iter().sum::<f32>()) / POINTS as f32;
        (mean * 0.5).sqrt() + holes
    }
}

/// Points that lie about evenly: each the farthest from those before it.
fn even(points: &[[f32; 2]]) -> [[f32; 2]; POINTS] {
    let mut apart = vec![f32::INFINITY; points.len()];
    let mut next = 0;
    std::array::from_fn(|_| {
        let [x, y] = points[next];
        next = 0;
        for (k, p) in points.iter().enumerate() {
            apart[k] = apart[k].min((p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y));
            if apart[k] > apart[next] {
                next = k;
            }
        }
        [x, y]
    })
}

/// The strokes of a glyph, with an empty rim, enlarged to at least [`THINNED_PX`] high. Returns their width too.
fn enlarged(darkness: &[u8], width: usize, share: f32) -> (Vec<bool>, usize) {
    let height = darkness.len() / width;
    let times = THINNED_PX.div_ceil(height.max(1));
    let most = darkness.iter().copied().max().unwrap_or(0);
    let value = |x: i32, y: i32| {
        let within = x >= 0 && y >= 0 && x < width as i32 && y < height as i32;
        if within { f32::from(darkness[y as usize * width + x as usize]) } else { 0.0 }
    };
    let (across, down) = (width * times + 2, height * times + 2);
    let mut strokes = vec![false; across * down];
    for y in 0..height * times {
        for x in 0..width * times {
            let [u, v] = [x, y].map(|k| (k as f32 + 0.5) / times as f32 - 0.5);
            let (left, top) = (u.floor(), v.floor());
            let (s, t) = (u - left, v - top);
            let (left, top) = (left as i32, top as i32);
            let row = |y: i32| value(left, y) * (1.0 - s) + value(left + 1, y) * s;
            strokes[(y + 1) * across + x + 1] = row(top) * (1.0 - t) + row(top + 1) * t > share * f32::from(most);
        }
    }
    (strokes, across)
}

/// Number of the holes within strokes.
fn holes(strokes: &[bool], width: usize) -> usize {
    let least = LEAST_HOLE * strokes.len() as f32;
    let mut seen = strokes.to_vec();
    let mut count = 0;
    for first in 0..seen.len() {
        if seen[first] {
            continue;
        }
        let (mut area, mut next) = (0, vec![first]);
        while let Some(at) = next.pop() {
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            area += 1;
            let beside = [at.checked_sub(1), Some(at + 1), at.checked_sub(width), Some(at + width)];
            next.extend(beside.into_iter().flatten().filter(|&at| at < strokes.len()));
        }
        // The first is the paper around.
        count += usize::from(first > 0 && area as f32 >= least);
    }
    count
}

/// Whether a pixel of a stroke goes in one of the two steps of thinning, by which of its neighbours are strokes: one bit
/// each, clockwise from above.
fn goes(around: u8, step: usize) -> bool {
    let is = |k: u32| around >> (k % 8) & 1 != 0;
    let turns = (0..8).filter(|&k| !is(k) && is(k + 1)).count();
    let [n, e, s, w] = [0, 2, 4, 6].map(is);
    let side = if step == 0 { !(e && s && (n || w)) } else { !(n && w && (e || s)) };
    (2..=6).contains(&around.count_ones()) && turns == 1 && side
}

/// The middle lines of strokes, one pixel wide, as places of pixels (Zhang and Suen 1984, doi 10.1145/357994.358023).
fn thinned(mut strokes: Vec<bool>, width: usize) -> Vec<usize> {
    let goes: [[bool; 256]; 2] = std::array::from_fn(|step| std::array::from_fn(|around| goes(around as u8, step)));
    let mut left: Vec<usize> = (width..strokes.len() - width).filter(|at| strokes[*at]).collect();
    loop {
        let before = left.len();
        for goes in &goes {
            let is_gone = |&&at: &&usize| {
                let [above, below] = [at - width, at + width];
                let around = [above, above + 1, at + 1, below + 1, below, below - 1, at - 1, above - 1];
                let bits = around.iter().rev().fold(0, |bits, &at| bits << 1 | usize::from(strokes[at]));
                goes[bits]
            };
            let gone: Vec<usize> = left.iter().filter(is_gone).copied().collect();
            gone.into_iter().for_each(|at| strokes[at] = false);
            left.retain(|&at| strokes[at]);
        }
        if left.len() == before {
            return left;
        }
    }
}
