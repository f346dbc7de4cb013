//! Finds which tones of a drawing are wall: light lines on a dark ground, grey walls, faint ink.
//!
//! The usual threshold stays wherever it finds lines that could be walls, so that clean drawings read as they always did.

use super::components::{Components, Neighbours, around};

/// Default lightness at which wall ends and floor begins.
pub(super) const USUAL_THRESHOLD: u8 = 128;
/// Lightness below which a pixel is surely dark, unless walls are grey.
pub(super) const SURELY_DARK: u8 = 100;
/// Most pixels that a measure looks at.
const MOST_SAMPLES: usize = 4096;
/// Least length of a piece that may be wall, as a share of the image's longer side.
const LONG_SHARE: f64 = 0.08;
/// Greatest thickness of walls, as a share of the image's shorter side.
const THICKEST_WALL: f64 = 0.04;
/// The same beside thin lines, which white rooms in a black mass have not.
const THICKEST_BESIDE_LINES: f64 = 0.08;
/// Least share of light pixels in such lines.
const LINES_SHARE: f64 = 0.02;
/// Least share of the places between lines with lines on three sides of them.
const ENCLOSED_SHARE: f64 = 0.55;
/// The same of grey that is as many times as thick as dark lines.
const FILL_IN_LINES: f64 = 6.0;
const ENCLOSED_BY_FILL: f64 = 0.3;
/// Least lightness of white paper.
const WHITE: u8 = 230;
/// As how much of coloured ink black ink is little: one in so many pixels.
const LITTLE_INK: usize = 12;
/// Cells along the image's longer side in which long pieces are counted.
const CELLS: usize = 48;
/// Share of a grey beside darker pixels from which it is their soft edge, and by how much those are darker at least.
const RIM_SHARE: f64 = 0.75;
const EDGE_CONTRAST: u8 = 60;
/// Half the width of a tone's peak in the histogram.
const PEAK: usize = 5;
/// Least difference between paper and ink.
const LEAST_CONTRAST: u8 = 24;

/// The indices of the pixels at the image's sides.
pub(super) fn rim(width: usize, height: usize) -> impl Iterator<Item = usize> {
    let ends = (0..width).flat_map(move |x| [x, (height - 1) * width + x]);
    ends.chain((0..height).flat_map(move |y| [y * width, y * width + width - 1]))
}

/// Pixels per lightness; coloured pixels do not count.
pub(super) fn histogram(lightness: &[u8], coloured: &[u8]) -> [usize; 256] {
    let mut counts = [0; 256];
    if coloured.is_empty() {
        lightness.iter().for_each(|&l| counts[usize::from(l)] += 1);
    } else {
        let plain = lightness.iter().zip(coloured).filter(|&(_, &c)| c == 0);
        plain.for_each(|(&l, _)| counts[usize::from(l)] += 1);
    }
    counts
}

/// Whether walls are light on a dark ground: the ground is the majority and lies at the image's sides, the light lines
/// are thin, long and enclose places.
pub(super) fn is_inverted(width: usize, lightness: &[u8], coloured: &[u8]) -> bool {
    let counts = histogram(lightness, coloured);
    let total: usize = counts.iter().sum();
    let split = usual_split(&counts);
    let below = counts[..usize::from(split)].iter().sum::<usize>();
    if total == 0 || below * 2 < total || !has_both(&counts, split) {
        return false;
    }
    let height = lightness.len() / width;
    let dark = rim(width, height).filter(|&at| lightness[at] < split).count();
    if dark * 20 < rim(width, height).count() * 17 {
        return false;
    }
    let is_light = |l: u8| l >= split;
    let light = runs(width, lightness, |at| is_plain(coloured, at) && is_light(lightness[at]), is_light);
    let ground = thickness(width, lightness, |at| !is_light(lightness[at]), |l| !is_light(l));
    let (Some(lines), Some(ground)) = (median(&light), ground) else { return false };
    let in_lines = light.iter().filter(|&&[short, long]| 3.0 * short as f64 <= lines && long as f64 >= 1.5 * lines);
    let has_lines = in_lines.count() as f64 >= LINES_SHARE * light.len() as f64;
    let share = if has_lines { THICKEST_BESIDE_LINES } else { THICKEST_WALL * 0.75 };
    if lines > (width.min(height) as f64 * share).max(2.0) || ground < 2.5 * lines {
        return false;
    }
    let mask: Vec<u8> =
        lightness.iter().enumerate().map(|(at, &l)| u8::from(is_plain(coloured, at) && is_light(l))).collect();
    encloses(&mask, width)
}

/// Whether walls are of saturated colour: what is dark and coloured is as thin as walls and covers more of the image than
/// what is dark and grey; if there is much of that, it encloses places too. `luma` is of the colours as they are.
pub(super) fn walls_are_coloured(width: usize, luma: &[u8], coloured: &[u8]) -> bool {
    let is_dark = |l: u8| l < USUAL_THRESHOLD;
    let is_ink = |at: usize| is_dark(luma[at]) && coloured[at] != 0;
    let count = (0..luma.len()).filter(|&at| is_ink(at)).count();
    if count * 200 < luma.len() {
        return false;
    }
    let height = luma.len() / width;
    let thickest = (width.min(height) as f64 * THICKEST_WALL).max(2.0);
    if thickness(width, luma, is_ink, is_dark).is_none_or(|lines| lines > thickest) {
        return false;
    }
    let net_of = |is_in: &dyn Fn(usize) -> bool| {
        let mask: Vec<u8> = (0..luma.len()).map(|at| u8::from(is_in(at))).collect();
        Net::of(&mask, width)
    };
    let plain = net_of(&|at| is_dark(luma[at]) && coloured[at] == 0);
    let all = net_of(&|at| is_dark(luma[at]));
    // On white paper with hardly any black ink, there is no other.
    let is_only_ink = || {
        let plain = |is_it: &dyn Fn(u8) -> bool| {
            luma.iter().zip(coloured).filter(|&(&l, &coloured)| coloured == 0 && is_it(l)).count()
        };
        plain(&is_dark) * LITTLE_INK <= count && plain(&|l| l >= WHITE) * 2 >= luma.len()
    };
    plain.cells() * 2 <= all.cells()
        && all.is_large(width, height)
        && (all.enclosed() >= ENCLOSED_SHARE || is_only_ink())
}

/// Whether long pieces of a mask spread over a good part of the image, as walls do.
pub(super) fn has_lines(mask: &[u8], width: usize) -> bool {
    Net::of(mask, width).is_large(width, mask.len() / width)
}

/// The same where they are round places too.
pub(super) fn encloses(mask: &[u8], width: usize) -> bool {
    let net = Net::of(mask, width);
    net.is_large(width, mask.len() / width) && net.enclosed() >= ENCLOSED_SHARE
}

fn is_plain(coloured: &[u8], at: usize) -> bool {
    coloured.is_empty() || coloured[at] == 0
}

/// The lightness at which walls end: 128, unless it finds no lines that could be walls and another one does.
pub(super) fn wall_threshold(width: usize, lightness: &[u8], coloured: &[u8]) -> u8 {
    let counts = histogram(lightness, coloured);
    let total: usize = counts.iter().sum();
    let usual = usize::from(USUAL_THRESHOLD);
    let peak = |at: usize| counts[at.saturating_sub(2)..(at + 3).min(256)].iter().sum::<usize>();
    let commonest = |from: usize| (from..256).max_by_key(|&l| (peak(l), l)).unwrap_or(255);
    let any = commonest(0);
    let light: usize = counts[usual..].iter().sum();
    let paper = if light * 10 >= total { commonest(usual) } else { any };
    if paper < usual + usize::from(LEAST_CONTRAST) {
        // Dim paper: the usual threshold is too near to it, or beyond it.
        let ink = quantile(&counts[..paper.saturating_sub(usize::from(LEAST_CONTRAST))], 0.25);
        return match ink {
            Some(ink) if peak(paper) * 3 >= total => ((ink + paper).div_ceil(2)).clamp(1, 255) as u8,
            _ => USUAL_THRESHOLD,
        };
    }
    let peaks = grey_peaks(&counts, total, paper);
    let dark: usize = counts[..usual].iter().sum();
    if peaks.is_empty() && dark * 1000 >= total {
        return USUAL_THRESHOLD;
    }
    let net_of = |is_in: &dyn Fn(u8) -> bool| {
        let mask: Vec<u8> =
            lightness.iter().enumerate().map(|(at, &l)| u8::from(is_plain(coloured, at) && is_in(l))).collect();
        Net::of(&mask, width)
    };
    let height = lightness.len() / width;
    let thickest = (width.min(height) as f64 * THICKEST_WALL).max(2.0);
    let is_dark = |l: u8| l < USUAL_THRESHOLD;
    let dark_net = net_of(&is_dark);
    let dark_lines = thickness(width, lightness, |at| is_dark(lightness[at]), is_dark);
    // The soft edges of darker lines are no grey walls.
    let is_rim = |is_grey: &dyn Fn(u8) -> bool| {
        let (mut count, mut at_line) = (0usize, 0usize);
        for at in (0..lightness.len()).filter(|&at| is_plain(coloured, at) && is_grey(lightness[at])) {
            let beside = [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width];
            count += 1;
            let darker = lightness[at].saturating_sub(EDGE_CONTRAST);
            let is_line = |l: u8| is_dark(l) || l < darker;
            at_line += usize::from(beside.iter().any(|&b| lightness.get(b).is_some_and(|&l| is_line(l))));
        }
        at_line as f64 > RIM_SHARE * count as f64
    };
    for grey in peaks {
        let threshold = ((grey + paper).div_ceil(2)) as u8;
        let is_wall = |l: u8| l < threshold;
        let near = |l: u8| usize::from(l).abs_diff(grey) <= PEAK;
        let Some(lines) = thickness(width, lightness, |at| is_plain(coloured, at) && near(lightness[at]), is_wall)
        else {
            continue;
        };
        if lines > thickest || is_rim(&near) {
            continue;
        }
        // Dark pieces are letters and the like, or lines thinner than the grey ones.
        let all = net_of(&is_wall);
        let greys: usize = counts[usual..usize::from(threshold)].iter().sum();
        let replaces = dark_net.cells() * 4 <= all.cells() && dark * 3 <= greys;
        let grey_alone = || net_of(&|l| (usize::from(l) + 3 * PEAK >= grey) && l < threshold);
        let is_thicker = || {
            let net = grey_alone();
            // The fill of outlines ends at windows and doors, and those far from each other enclose less.
            let is_fill = dark_lines.is_some_and(|dark| lines >= FILL_IN_LINES * dark.max(1.0));
            lines >= 3.0
                && dark_lines.is_some_and(|dark| lines >= 1.8 * dark.max(1.0))
                && net.cells() * if is_fill { 3 } else { 2 } >= dark_net.cells()
                && net.is_large(width, height)
                && net.enclosed() >= if is_fill { ENCLOSED_BY_FILL } else { ENCLOSED_SHARE }
        };
        if all.is_large(width, height) && all.enclosed() >= ENCLOSED_SHARE && (replaces || is_thicker()) {
            return threshold;
        }
    }
    if dark_net.cells() > 0 || dark * 1000 >= total {
        return USUAL_THRESHOLD;
    }
    // Faint ink of no tone of its own.
    let faint = quantile(&counts[..paper - usize::from(LEAST_CONTRAST)], 0.25);
    match faint.map(|ink| (ink + paper).div_ceil(2) as u8) {
        Some(threshold) if net_of(&|l| l < threshold).is_large(width, height) => threshold,
        _ => USUAL_THRESHOLD,
    }
}

/// Lightens the soft edges of black strokes on paper that a threshold for grey walls would take for wall: the strokes would be
/// thicker than they are.
pub(super) fn lighten_rims(width: usize, lightness: &mut [u8], threshold: u8) {
    if threshold <= USUAL_THRESHOLD {
        return;
    }
    let is_soft = |at: &usize| {
        let near = |is_it: &dyn Fn(u8) -> bool| {
            around(*at, width).any(|beside| lightness.get(beside).is_some_and(|&l| is_it(l)))
        };
        (SURELY_DARK..threshold).contains(&lightness[*at]) && near(&|l| l < SURELY_DARK) && near(&|l| l >= threshold)
    };
    let soft: Vec<usize> = (0..lightness.len()).filter(is_soft).collect();
    // The usual threshold becomes the other one.
    let span = 255 - u32::from(USUAL_THRESHOLD);
    for at in soft {
        lightness[at] = match lightness[at].checked_sub(USUAL_THRESHOLD) {
            Some(above) => threshold + (u32::from(255 - threshold) * u32::from(above) / span) as u8,
            None => threshold - 1,
        };
    }
}

/// The threshold half way between ink and even paper of 255.
pub(super) fn ink_threshold(lightness: &[u8]) -> u8 {
    let counts = histogram(lightness, &[]);
    let ink = quantile(&counts[..208], 0.3).unwrap_or(0);
    ((ink + 255) / 2).clamp(112, 192) as u8
}

/// Tones between the usual threshold and the paper that stand out from the histogram, darkest first.
fn grey_peaks(counts: &[usize; 256], total: usize, paper: usize) -> Vec<usize> {
    let sum = |from: usize, to: usize| counts[from.min(256)..to.min(256)].iter().sum::<usize>();
    let mass = |l: usize| sum(l.saturating_sub(PEAK), l + PEAK + 1);
    let range = usize::from(USUAL_THRESHOLD) - PEAK..paper.saturating_sub(20);
    let is_peak = |&l: &usize| {
        let around = sum(l.saturating_sub(3 * PEAK), l.saturating_sub(PEAK)) + sum(l + PEAK + 1, l + 3 * PEAK + 1);
        mass(l) * 500 >= total && mass(l) * 2 >= around * 3
    };
    let mut peaks: Vec<usize> = Vec::new();
    for l in range.filter(is_peak) {
        match peaks.last_mut() {
            Some(last) if l - *last <= 2 * PEAK => {
                if counts[l] > counts[*last] {
                    *last = l;
                }
            }
            _ => peaks.push(l),
        }
    }
    peaks.retain(|&l| l >= usize::from(USUAL_THRESHOLD) - PEAK);
    peaks
}

/// The tone below which a share of the counted pixels lies.
fn quantile(counts: &[usize], share: f64) -> Option<usize> {
    let total: usize = counts.iter().sum();
    let mut seen = 0;
    counts.iter().position(|&count| {
        seen += count;
        seen > 0 && seen as f64 >= share * total as f64
    })
}

/// Whether each side of a lightness has some of the pixels.
fn has_both(counts: &[usize; 256], split: u8) -> bool {
    let total: usize = counts.iter().sum();
    let below: usize = counts[..usize::from(split)].iter().sum();
    below * 200 >= total && (total - below) * 200 >= total
}

/// The usual threshold, or another: all tones of a dim drawing may lie on one side of it.
fn usual_split(counts: &[usize; 256]) -> u8 {
    if has_both(counts, USUAL_THRESHOLD) { USUAL_THRESHOLD } else { between(counts) as u8 }
}

/// The lightness from which walls on a dark ground are light.
pub(super) fn light_from(lightness: &[u8], coloured: &[u8]) -> u8 {
    usual_split(&histogram(lightness, coloured))
}

/// The lightness that tells two classes of plain pixels best apart.
pub(super) fn split(lightness: &[u8], coloured: &[u8]) -> u8 {
    between(&histogram(lightness, coloured)) as u8
}

/// The threshold that tells two classes of tones best apart (Otsu).
fn between(counts: &[usize; 256]) -> usize {
    let weighted = |l: usize| l as f64 * counts[l] as f64;
    let (total, sum) = (counts.iter().sum::<usize>() as f64, (0..256).map(weighted).sum::<f64>());
    let (mut below, mut sum_below, mut best) = (0.0, 0.0, (0.0, 128));
    for t in 1..256 {
        below += counts[t - 1] as f64;
        sum_below += weighted(t - 1);
        let above = total - below;
        if below > 0.0 && above > 0.0 {
            let apart = sum_below / below - (sum - sum_below) / above;
            let score = below * above * apart * apart;
            if score > best.0 {
                best = (score, t);
            }
        }
    }
    best.1
}

/// Median thickness at chosen pixels of the class that `is_in` describes, pixels.
fn thickness(
    width: usize,
    lightness: &[u8],
    chosen: impl Fn(usize) -> bool,
    is_in: impl Fn(u8) -> bool,
) -> Option<f64> {
    median(&runs(width, lightness, chosen, is_in))
}

/// Median of the shorter runs.
fn median(runs: &[[usize; 2]]) -> Option<f64> {
    runs.get(runs.len() / 2).map(|&[short, _]| short as f64)
}

/// The shorter and the longer of the runs across and down at chosen pixels of the class that `is_in` describes, pixels;
/// the shortest first.
pub(super) fn runs(
    width: usize,
    lightness: &[u8],
    chosen: impl Fn(usize) -> bool,
    is_in: impl Fn(u8) -> bool,
) -> Vec<[usize; 2]> {
    let places: Vec<usize> = (0..lightness.len()).filter(|&at| chosen(at)).collect();
    let height = lightness.len() / width;
    let limit = width.max(height) / 4 + 1;
    let step = places.len().div_ceil(MOST_SAMPLES).max(1);
    let run = |at: usize, stride: usize, before: usize, after: usize| {
        let back = (1..=before.min(limit)).take_while(|k| is_in(lightness[at - k * stride])).count();
        let on = (1..=after.min(limit)).take_while(|k| is_in(lightness[at + k * stride])).count();
        back + on + 1
    };
    let at_place = |&at: &usize| {
        let (x, y) = (at % width, at / width);
        let (across, down) = (run(at, 1, x, width - 1 - x), run(at, width, y, height - 1 - y));
        [across.min(down), across.max(down)]
    };
    let mut runs: Vec<[usize; 2]> = places.iter().step_by(step).map(at_place).collect();
    runs.sort_unstable();
    runs
}

/// The long pieces of a mask.
struct Net {
    width: usize,
    mask: Vec<u8>,
    min: [usize; 2],
    end: [usize; 2],
    touched: Vec<bool>,
}

impl Net {
    fn of(mask: &[u8], width: usize) -> Net {
        let height = mask.len() / width;
        let side = width.max(height).div_ceil(CELLS).max(1);
        let mut net = Net {
            width,
            mask: vec![0; mask.len()],
            min: [width, height],
            end: [0; 2],
            touched: vec![false; CELLS * CELLS],
        };
        let pieces = Components::of(mask, width, 1, Neighbours::Eight);
        let long = LONG_SHARE * width.max(height) as f64;
        for piece in pieces.all.iter().filter(|p| f64::from(p.larger_side()) >= long) {
            pieces.paint(piece, &mut net.mask, width, 1);
            for axis in 0..2 {
                net.min[axis] = net.min[axis].min(piece.min[axis] as usize);
                net.end[axis] = net.end[axis].max(piece.end[axis] as usize);
            }
            for run in pieces.runs(piece) {
                let row = run.y as usize / side * CELLS;
                net.touched[row + run.from as usize / side..=row + (run.to as usize - 1) / side].fill(true);
            }
        }
        net
    }

    /// Cells of the image that the pieces touch.
    fn cells(&self) -> usize {
        self.touched.iter().filter(|&&t| t).count()
    }

    /// Whether it spreads over a good part of the image.
    fn is_large(&self, width: usize, height: usize) -> bool {
        let size = [self.end[0].saturating_sub(self.min[0]), self.end[1].saturating_sub(self.min[1])];
        size[0] * 4 >= width && size[1] * 4 >= height
    }

    /// Share of the places within its bounds from which three of the four axes meet it.
    fn enclosed(&self) -> f64 {
        const PLACES: usize = 40;
        let (mut all, mut enclosed) = (0usize, 0usize);
        for place in 0..PLACES * PLACES {
            let at = |k: usize, axis: usize| {
                self.min[axis] + (2 * k + 1) * self.end[axis].saturating_sub(self.min[axis]) / (2 * PLACES)
            };
            let (x, y) = (at(place % PLACES, 0), at(place / PLACES, 1));
            let is_in = |x: usize, y: usize| self.mask[y * self.width + x] != 0;
            if x >= self.end[0] || y >= self.end[1] || is_in(x, y) {
                continue;
            }
            let met = [
                (self.min[0]..x).any(|x| is_in(x, y)),
                (x..self.end[0]).any(|x| is_in(x, y)),
                (self.min[1]..y).any(|y| is_in(x, y)),
                (y..self.end[1]).any(|y| is_in(x, y)),
            ];
            all += 1;
            enclosed += usize::from(met.iter().filter(|&&m| m).count() >= 3);
        }
        if all == 0 { 0.0 } else { enclosed as f64 / all as f64 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 300;

    /// Two rows of rooms with doors, walls of 5 pixels, in two tones.
    fn rooms(paper: u8, wall: u8) -> Vec<u8> {
        let mut drawing = vec![paper; WIDTH * 200];
        let mut fill = |x: std::ops::Range<usize>, y: std::ops::Range<usize>, tone: u8| {
            y.for_each(|y| drawing[y * WIDTH + x.start..y * WIDTH + x.end].fill(tone));
        };
        for y in [20, 85, 110, 175] {
            fill(20..280, y..y + 5, wall);
        }
        for x in [20, 84, 148, 212, 275] {
            fill(x..x + 5, 20..90, wall);
            fill(x..x + 5, 110..180, wall);
        }
        for x in [45, 110, 175, 240] {
            fill(x..x + 14, 85..90, paper);
            fill(x..x + 14, 110..115, paper);
        }
        drawing
    }

    /// Three rows of walls, filled with grey between black outlines as far as windows of two lines leave it.
    fn filled_outlines(grey: u8) -> Vec<u8> {
        let mut drawing = vec![255; WIDTH * 200];
        let mut fill = |[x0, y0, x1, y1]: [usize; 4], tone: u8| {
            (y0..y1).for_each(|y| drawing[y * WIDTH + x0..y * WIDTH + x1].fill(tone));
        };
        // Windows first: walls lie over their ends.
        for at in [20, 96, 172] {
            [at, at + 7].into_iter().for_each(|y| fill([20, y, 280, y + 1], 0));
        }
        for at in [20, 104, 188, 272] {
            [at, at + 7].into_iter().for_each(|x| fill([x, 20, x + 1, 180], 0));
        }
        for y in [20, 96, 172] {
            for x in [20, 104, 188, 272] {
                let ends =
                    [[x.max(46) - 26, y, (x + 34).min(280), y + 8], [x, y.max(46) - 26, x + 8, (y + 34).min(180)]];
                ends.into_iter().for_each(|end| fill(end, 0));
                ends.into_iter().for_each(|[x0, y0, x1, y1]| fill([x0 + 1, y0 + 1, x1 - 1, y1 - 1], grey));
            }
        }
        drawing
    }

    #[test]
    fn fills_that_windows_interrupt_are_wall() {
        let threshold = wall_threshold(WIDTH, &filled_outlines(179), &[]);
        assert!((180..=240).contains(&threshold), "{threshold}");
    }

    #[test]
    fn black_walls_on_white_keep_the_usual_threshold() {
        assert_eq!(wall_threshold(WIDTH, &rooms(255, 0), &[]), 128);
        assert!(!is_inverted(WIDTH, &rooms(255, 0), &[]));
    }

    #[test]
    fn grey_walls_are_found_beside_black_letters_and_lines() {
        for grey in [130, 160, 190, 215] {
            let mut drawing = rooms(255, grey);
            for k in 0..60 {
                drawing[(50 + k / 10 * 7) * WIDTH + 40 + k % 10 * 3] = 0;
            }
            // A dimension line and the sheet's frame.
            drawing[10 * WIDTH + 20..10 * WIDTH + 280].fill(0);
            drawing[2 * WIDTH + 2..2 * WIDTH + 298].fill(0);
            drawing[197 * WIDTH + 2..197 * WIDTH + 298].fill(0);
            let threshold = wall_threshold(WIDTH, &drawing, &[]);
            assert!((grey + 10..250).contains(&threshold), "{grey}: {threshold}");
        }
    }

    #[test]
    fn grey_furniture_and_grey_rooms_are_no_walls() {
        let mut drawing = rooms(255, 0);
        for y in 30..75 {
            drawing[y * WIDTH + 30..y * WIDTH + 70].fill(170);
            drawing[y * WIDTH + 160..y * WIDTH + 200].fill(200);
        }
        assert_eq!(wall_threshold(WIDTH, &drawing, &[]), 128);
    }

    #[test]
    fn light_walls_on_a_dark_ground_are_found() {
        for (paper, wall) in [(30, 220), (0, 255), (40, 110), (60, 130), (100, 250)] {
            assert!(is_inverted(WIDTH, &rooms(paper, wall), &[]), "{wall} on {paper}");
        }
    }

    /// Thick walls about two rooms and a corridor, with leaves of doors and panes of windows in thin lines if there are such.
    fn small_flat(paper: u8, wall: u8, has_lines: bool) -> Vec<u8> {
        let mut drawing = vec![paper; WIDTH * 200];
        let mut fill = |x: std::ops::Range<usize>, y: std::ops::Range<usize>, tone: u8| {
            y.for_each(|y| drawing[y * WIDTH + x.start..y * WIDTH + x.end].fill(tone));
        };
        for y in [20, 110, 170] {
            fill(20..280, y..y + 12, wall);
        }
        for (x, y) in [(20, 20..182), (268, 20..182), (140, 20..110)] {
            fill(x..x + 12, y, wall);
        }
        for x in [60, 190] {
            fill(x..x + 30, 110..122, paper);
            if has_lines {
                fill(x..x + 2, 80..110, wall);
                fill(x..x + 40, 20..32, paper);
                [20, 25, 30].into_iter().for_each(|y| fill(x..x + 40, y..y + 2, wall));
            }
        }
        drawing
    }

    #[test]
    fn thick_light_walls_beside_thin_lines_are_a_blueprint_and_alone_are_corridors() {
        assert!(is_inverted(WIDTH, &small_flat(60, 240, true), &[]));
        assert!(!is_inverted(WIDTH, &small_flat(60, 240, false), &[]));
        assert!(!is_inverted(WIDTH, &small_flat(240, 60, true), &[]));
    }

    #[test]
    fn white_rooms_in_a_black_mass_are_no_lines() {
        let mut drawing = vec![0; WIDTH * 200];
        for (x, y, w, h) in [(30, 30, 240, 30), (30, 30, 30, 140), (240, 30, 30, 140), (30, 140, 240, 30)] {
            (y..y + h).for_each(|y| drawing[y * WIDTH + x..y * WIDTH + x + w].fill(255));
        }
        assert!(!is_inverted(WIDTH, &drawing, &[]));
    }

    #[test]
    fn dim_paper_has_its_threshold_below() {
        let threshold = wall_threshold(WIDTH, &rooms(120, 10), &[]);
        assert!((30..110).contains(&threshold), "{threshold}");
    }
}
