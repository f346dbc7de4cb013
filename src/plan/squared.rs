//! Squared paper: the lines of exercise books and graph paper, which are no strokes.

use std::ops::Range;

/// Bands across the lines of a family in which they are looked for: sheets of photographs are not quite flat.
const BANDS: usize = 8;
/// Fewest lines of a family, least space between two, pixels, and greatest, as a share of the sheet.
const FEWEST: usize = 10;
const LEAST_SPACE_PX: usize = 8;
const GREATEST_SPACE: f64 = 0.08;
/// How much darker than what is beside it a line is, and half of its greatest thickness, pixels.
const DARKER: u8 = 10;
const HALF_PX: usize = 3;
/// Share of a band along which a line shows, and one at a margin.
const SHOWN: f64 = 0.55;
const SHOWN_AT_MARGIN: f64 = 0.9;
/// How far off its place a line may be, as a share of the space between two.
const OFF: f64 = 0.12;
/// Least share of a sheet that a family covers, and of its lines that are seen.
const COVERED: f64 = 0.85;
const SEEN: f64 = 0.8;
/// How much darker than a line the strokes over it are at least.
const INK: u8 = 14;
/// So many lines to either side are about as dark.
const ALIKE: usize = 3;

/// Takes the lines of squared paper off a drawing on light paper: two families of fine lines over all of the sheet, as far
/// apart. Strokes that lie over them stay, as they are darker.
pub(super) fn lighten(width: usize, lightness: &mut [u8]) {
    let grid = Grid { width, height: lightness.len() / width.max(1) };
    let families = [false, true].map(|is_level| grid.families(lightness, is_level));
    let [Some(upright), Some(level)] = families else { return };
    // Where both cross, one looks like a stroke over the other as long as that is there.
    for (families, is_level) in [(&upright, false), (&level, true), (&upright, false)] {
        for family in families {
            grid.pixels(lightness, family, is_level).into_iter().for_each(|at| lightness[at] = 255);
        }
    }
}

/// The pixels of a sheet.
struct Grid {
    width: usize,
    height: usize,
}

/// Where a band has lines, and which of them show all along it.
struct Seen {
    band: Range<usize>,
    places: Vec<usize>,
    whole: Vec<usize>,
}

/// Places of a family's lines, band by band.
type Family = Vec<(Range<usize>, Vec<usize>)>;

impl Grid {
    /// How many lines of pixels there are along a family's lines, and how long those are.
    fn size(&self, is_level: bool) -> [usize; 2] {
        if is_level { [self.height, self.width] } else { [self.width, self.height] }
    }

    fn at(&self, place: usize, along: usize, is_level: bool) -> usize {
        if is_level { place * self.width + along } else { along * self.width + place }
    }

    /// The upright or level lines of squared paper, if there are such, and lines at its margins.
    fn families(&self, lightness: &[u8], is_level: bool) -> Option<[Family; 2]> {
        let [places, length] = self.size(is_level);
        let bands = (0..BANDS).map(|k| k * length / BANDS..(k + 1) * length / BANDS);
        let seen: Vec<Seen> = bands.map(|band| self.seen(lightness, band, is_level)).collect();
        let mut spaces: Vec<usize> =
            seen.iter().flat_map(|seen| seen.places.array_windows().map(|[a, b]| b - a)).collect();
        spaces.sort_unstable();
        let space = *spaces.get(spaces.len() / 2)?;
        if !(LEAST_SPACE_PX as f64..=GREATEST_SPACE * places as f64).contains(&(space as f64)) {
            return None;
        }
        let found: Vec<Option<Vec<usize>>> = seen.iter().map(|seen| tracked(&seen.places, space, places)).collect();
        if found.iter().flatten().count() * 4 < BANDS * 3 {
            return None;
        }
        // Where a drawing hides the lines, they lie as in the next band.
        let nearest = |band: usize| {
            let all = (0..found.len()).filter(|&k| found[k].is_some());
            all.min_by_key(|k| k.abs_diff(band)).and_then(|k| found[k].clone()).unwrap_or_default()
        };
        let squares: Family = seen.iter().enumerate().map(|(k, seen)| (seen.band.clone(), nearest(k))).collect();
        // The line at a margin runs from end to end as well.
        let is_at = |place: usize, all: &[usize]| all.iter().any(|other| other.abs_diff(place) <= HALF_PX);
        let margins = seen.iter().zip(&squares).map(|(own, (band, squares))| {
            let is_margin =
                |place: &usize| !is_at(*place, squares) && seen.iter().all(|seen| is_at(*place, &seen.whole));
            (band.clone(), own.whole.iter().copied().filter(is_margin).collect())
        });
        let margins = margins.collect();
        Some([squares, margins])
    }

    /// Places in a band along which the paper is darker than beside it.
    fn seen(&self, lightness: &[u8], band: Range<usize>, is_level: bool) -> Seen {
        let [places, _] = self.size(is_level);
        let beside = HALF_PX + 2;
        let (mut counts, mut dark) = (vec![0usize; places], vec![0u32; places]);
        for along in band.clone() {
            let of = |place: usize| lightness[self.at(place, along, is_level)];
            let mut last = None;
            for (place, dark) in dark.iter_mut().enumerate().take(places.saturating_sub(beside)).skip(beside) {
                let darker = of(place - beside).min(of(place + beside)).saturating_sub(of(place));
                if darker < DARKER {
                    continue;
                }
                *dark += u32::from(darker);
                // A wavy line counts once where it moves aside by a pixel.
                let from = (place - 1).max(last.map_or(0, |last| last + 1));
                (from..=place + 1).for_each(|near| counts[near] += 1);
                last = Some(place + 1);
            }
        }
        let least = (SHOWN * band.len() as f64) as usize;
        let is_peak = |&place: &usize| {
            let around = place.saturating_sub(HALF_PX)..(place + HALF_PX + 1).min(places);
            let first_darkest = around.max_by_key(|&near| (dark[near], std::cmp::Reverse(near)));
            counts[place] >= least.max(1) && first_darkest == Some(place)
        };
        let found: Vec<usize> = (0..places).filter(is_peak).collect();
        let is_whole = |place: &usize| counts[*place] as f64 >= SHOWN_AT_MARGIN * band.len() as f64;
        Seen { whole: found.iter().copied().filter(is_whole).collect(), places: found, band }
    }

    /// The pixels of a family's lines that are no strokes.
    fn pixels(&self, lightness: &[u8], family: &Family, is_level: bool) -> Vec<usize> {
        let [places, _] = self.size(is_level);
        // Strokes cross a line wherever it is about as dark beside it, on both sides.
        let step = if is_level { [self.width, 1] } else { [1, self.width] };
        let mut found = Vec::new();
        for (band, lines) in family {
            let across = |line: usize, along: usize| {
                let near = line.saturating_sub(HALF_PX)..(line + HALF_PX + 1).min(places);
                near.map(move |place| self.at(place, along, is_level))
            };
            let darkest = |line: usize, along: usize| across(line, along).map(|at| lightness[at]).min().unwrap_or(255);
            let tone = |line: &usize| middle(band.clone().map(|along| darkest(*line, along)).collect());
            let tones: Vec<u8> = lines.iter().map(tone).collect();
            for (k, &line) in lines.iter().enumerate() {
                // Walls lie along some lines.
                let tone = middle(tones[k.saturating_sub(ALIKE)..(k + ALIKE + 1).min(tones.len())].to_vec());
                let [ink, faint] = [tone.saturating_sub(INK), tone.midpoint(255)];
                let is_dark = |at: Option<usize>| at.and_then(|at| lightness.get(at)).is_some_and(|&l| l < faint);
                let near = |at: Option<usize>| {
                    let beside = |by: usize| [at.and_then(|at| at.checked_sub(by)), at.map(|at| at + by)];
                    (0..3).flat_map(|k| beside(k * step[1])).any(is_dark)
                };
                for along in band.clone() {
                    let (first, last) = (across(line, along).next(), across(line, along).next_back());
                    let is_crossed =
                        near(first.and_then(|at| at.checked_sub(step[0]))) && near(last.map(|at| at + step[0]));
                    if !is_crossed {
                        found.extend(across(line, along).filter(|&at| (ink..255).contains(&lightness[at])));
                    }
                }
            }
        }
        found
    }
}

/// The middle one of some tones.
fn middle(mut tones: Vec<u8>) -> u8 {
    tones.sort_unstable();
    tones.get(tones.len() / 2).copied().unwrap_or(255)
}

/// The lines of a band that lie a space apart, with those that something hides; `None` if they are no family.
fn tracked(seen: &[usize], space: usize, places: usize) -> Option<Vec<usize>> {
    let off = (OFF * space as f64).max(2.0) as usize;
    let nearest = |wanted: usize| {
        let near = seen.iter().filter(|place| place.abs_diff(wanted) <= off);
        near.min_by_key(|place| place.abs_diff(wanted)).copied()
    };
    // From the first pair that is a space apart, to both sides.
    let &[first, _] = seen.array_windows().find(|[a, b]| (b - a).abs_diff(space) <= off)?;
    let (mut lines, mut met) = (Vec::new(), 0);
    let mut follow = |step: i64| {
        let mut wanted = first as i64 + if step < 0 { step } else { 0 };
        while (0..places as i64).contains(&wanted) {
            let line = nearest(wanted as usize);
            met += usize::from(line.is_some());
            lines.push(line.unwrap_or(wanted as usize));
            wanted = lines[lines.len() - 1] as i64 + step;
        }
    };
    follow(-(space as i64));
    follow(space as i64);
    let [from, to] = [seen.first()?, seen.last()?];
    let is_family = met >= FEWEST
        && met as f64 >= SEEN * lines.len() as f64
        && (to - from) as f64 >= COVERED * places as f64
        // What else is as long lies between the lines.
        && seen.len() <= 2 * met;
    is_family.then_some(lines)
}
