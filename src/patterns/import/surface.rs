//! The clean wall under a stain: a smooth surface fitted to the logarithm of the light around it.
//!
//! ln I is the sum of the wall's colour and of slowly varying light: a polynomial in x and y of up to the fourth
//! degree (lamps, windows, lens vignetting) plus large-scale residuals of the wall. The fit must follow the wall and
//! ignore the stain. The first fit is an asymmetric, iteratively reweighted least squares (Holland and Welsch 1977,
//! doi 10.1080/03610927708827533; asymmetric after Eilers 2003, doi 10.1021/ac034173t). Later fits leave out the
//! pixels found to be stain.

use super::ImportError;
use super::photo::Photo;
use super::raster::{PixelRaster, quantile};
use super::stain;

/// Longest side of the raster on which the surface is fitted.
const COARSE_PX: usize = 320;
/// Least side of the raster of the first fit, if the photograph allows.
const LEAST_HALVED_PX: usize = 40;
/// Number of terms of a polynomial of degree 4.
const MOST_TERMS: usize = 15;
/// Least share of the photograph that is clean wall.
const LEAST_WALL: f64 = 0.12;
/// Largest share of the photograph's border that is stain.
const MOST_BORDER: f64 = 0.55;
/// Standard deviation of a normal distribution over the median of its absolute values.
const SD_OF_MEDIAN: f64 = 1.4826;

/// The fitted clean wall, at the resolution of the fit.
pub(super) struct WallSurface {
    /// Pixels of [`Photo`] per pixel of the fit.
    pub factor: usize,
    /// ln of the light of the clean wall, per channel.
    pub wall: [PixelRaster; 3],
    /// Density against the wall per channel, positive on the stain.
    pub residuals: [PixelRaster; 3],
    /// Mean of the residuals over the channels, smoothed.
    pub smooth: PixelRaster,
    /// Standard deviation of `smooth` on the clean wall.
    pub noise: f64,
    /// Whether the stain is lighter than the wall.
    pub lighter: bool,
}

/// Fits the clean wall of a photograph.
pub(super) fn fit(photo: &Photo) -> Result<WallSurface, ImportError> {
    let longest = photo.logs[0].width.max(photo.logs[0].height);
    let factor = longest.div_ceil(COARSE_PX).max(1);
    let logs = [0, 1, 2].map(|channel| photo.logs[channel].reduced(factor));
    let mean = PixelRaster::from_fn(logs[0].width, logs[0].height, |i, j| {
        let n = j * logs[0].width + i;
        (logs[0].values[n] + logs[1].values[n] + logs[2].values[n]) / 3.0
    });
    // The first fit has many steps and needs no detail.
    let halved = if mean.width.min(mean.height) >= 2 * LEAST_HALVED_PX { 2 } else { 1 };
    let small = mean.reduced(halved);
    let (dark, light) = (first_fit(&small, 1.0), first_fit(&small, -1.0));
    // Grime is darker than most walls; a lighter stain must stand out clearly.
    let (first, sign) = if light.mass > 2.0 * dark.mass { (light, -1.0) } else { (dark, 1.0) };
    let at = |n: usize, count: usize| (n / halved).min(count - 1);
    let in_small = |n: usize| at(n / mean.width, small.height) * small.width + at(n % mean.width, small.width);
    let mut stained: Vec<bool> = (0..mean.values.len()).map(|n| first.stained[in_small(n)]).collect();
    for _ in 0..4 {
        let surface = refit(&logs, &stained, sign, factor)?;
        stained = stain::around(&surface.smooth, surface.noise);
    }
    refit(&logs, &stained, sign, factor)
}

/// Result of the first, reweighted fit.
struct FirstFit {
    stained: Vec<bool>,
    /// Sum of the residuals on the stain's side.
    mass: f64,
}

/// Fits with asymmetric weights; `sign` is 1 for a stain darker than the wall, -1 for a lighter one.
fn first_fit(mean: &PixelRaster, sign: f32) -> FirstFit {
    let mut weights = vec![1.0f64; mean.values.len()];
    let mut residual = mean.clone();
    for step in 0..36 {
        // Low degrees first, so that the polynomial does not fit the stain.
        let degree = [1, 2, 3, 4][(step / 6).min(3)];
        let polynomial = Polynomial::fit(degree, mean.width, mean.height, &weights, &[mean]);
        let wall = polynomial.raster(0);
        residual = PixelRaster::from_fn(mean.width, mean.height, |i, j| {
            let n = j * mean.width + i;
            sign * (wall.values[n] - mean.values[n])
        });
        // Only the wall's unevenness lies on the side away from the stain.
        let sd = SD_OF_MEDIAN * quantile(residual.values.iter().filter(|r| **r < 0.0).map(|r| -r), 0.5);
        let sd = sd.max(1e-4);
        for (weight, &r) in weights.iter_mut().zip(&residual.values) {
            let r = f64::from(r) / sd;
            let square = r * r / 6.25;
            *weight = if r > 0.0 { 1.0 / (1.0 + square * square) } else { 1.0f64.min(3.0 / -r) };
        }
    }
    let smooth = smoothed(&residual);
    let noise = noise_of(smooth.values.iter().copied());
    let stained: Vec<bool> = smooth.values.iter().map(|&r| f64::from(r) > 3.0 * noise).collect();
    let over = |r: f32| (f64::from(r) - 4.0 * noise).max(0.0);
    FirstFit { stained, mass: smooth.values.iter().map(|&r| over(r)).sum() }
}

/// Fits the wall to the pixels that are not stained.
fn refit(logs: &[PixelRaster; 3], stained: &[bool], sign: f32, factor: usize) -> Result<WallSurface, ImportError> {
    let (width, height) = (logs[0].width, logs[0].height);
    let free = stained.iter().filter(|&&stained| !stained).count() as f64 / stained.len() as f64;
    let border = border_share(stained, width, height);
    if free < LEAST_WALL || border > MOST_BORDER {
        return Err(ImportError::FillsPhoto { wall_percent: 100.0 * free, border_percent: 100.0 * border });
    }
    // With less wall the light under the stain is less certain: a lower degree.
    let degree = if free > 0.5 {
        4
    } else if free > 0.3 {
        3
    } else {
        2
    };
    let weights: Vec<f64> = stained.iter().map(|&stained| f64::from(u8::from(!stained))).collect();
    let polynomial = Polynomial::fit(degree, width, height, &weights, &[&logs[0], &logs[1], &logs[2]]);
    let mut wall = [0, 1, 2].map(|channel| polynomial.raster(channel));
    for (wall, log) in wall.iter_mut().zip(logs) {
        let left = large_scale(log, wall, &weights);
        wall.values.iter_mut().zip(&left.values).for_each(|(wall, left)| *wall += left);
    }
    let residuals = [0, 1, 2].map(|channel: usize| {
        let (wall, log) = (&wall[channel].values, &logs[channel].values);
        let values = wall.iter().zip(log).map(|(wall, log)| sign * (wall - log)).collect();
        PixelRaster { width, height, values }
    });
    let mean = PixelRaster::from_fn(width, height, |i, j| {
        residuals.iter().map(|residual| residual.values[j * width + i]).sum::<f32>() / 3.0
    });
    let smooth = smoothed(&mean);
    let clean = smooth.values.iter().zip(stained).filter(|(_, stained)| !**stained);
    let noise = SD_OF_MEDIAN * quantile(clean.map(|(r, _)| r.abs()), 0.5);
    Ok(WallSurface { factor, wall, residuals, smooth, noise: noise.max(5e-4), lighter: sign < 0.0 })
}

/// Residuals of the polynomial at large scale: local means of the wall over a twelfth of the photograph.
///
/// Falls to zero away from clean wall.
fn large_scale(log: &PixelRaster, wall: &PixelRaster, weights: &[f64]) -> PixelRaster {
    let (width, height) = (log.width, log.height);
    let radius = (width.max(height) / 24).max(2);
    let weight = PixelRaster { width, height, values: weights.iter().map(|&weight| weight as f32).collect() };
    let left = PixelRaster::from_fn(width, height, |i, j| {
        let n = j * width + i;
        (log.values[n] - wall.values[n]) * weight.values[n]
    });
    let (sum, seen) = (left.blurred(radius, 3), weight.blurred(radius, 3));
    PixelRaster::from_fn(width, height, |i, j| {
        let n = j * width + i;
        sum.values[n] / (seen.values[n] + 0.08)
    })
}

/// Removes detail smaller than a hundredth of the photograph.
fn smoothed(residual: &PixelRaster) -> PixelRaster {
    let radius = (residual.width.max(residual.height) / 160).max(1);
    residual.blurred(radius, 2)
}

/// Standard deviation of the wall, from the residuals on the side without stain.
fn noise_of(residuals: impl Iterator<Item = f32>) -> f64 {
    (SD_OF_MEDIAN * quantile(residuals.filter(|r| *r < 0.0).map(|r| -r), 0.5)).max(5e-4)
}

/// Share of the outermost pixels that are stained.
fn border_share(stained: &[bool], width: usize, height: usize) -> f64 {
    let rows = (0..width).flat_map(|i| [i, (height - 1) * width + i]);
    let columns = (0..height).flat_map(|j| [j * width, j * width + width - 1]);
    let count = rows.chain(columns).filter(|&n| stained[n]).count();
    count as f64 / (2 * (width + height)) as f64
}

/// Polynomials in x and y, one per raster, for rasters of one size.
struct Polynomial {
    degree: usize,
    width: usize,
    height: usize,
    coefficients: Vec<[f64; MOST_TERMS]>,
}

impl Polynomial {
    /// Weighted least squares: minimises sum w (z - p(x, y))^2 by the normal equations.
    ///
    /// The basis is products of Legendre polynomials on -1 to 1, which keeps the equations well conditioned.
    fn fit(degree: usize, width: usize, height: usize, weights: &[f64], rasters: &[&PixelRaster]) -> Polynomial {
        let terms = (degree + 1) * (degree + 2) / 2;
        let mut normal = [[0.0f64; MOST_TERMS]; MOST_TERMS];
        let mut right = vec![[0.0f64; MOST_TERMS]; rasters.len()];
        let (across, down) = (legendre(width), legendre(height));
        for (n, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            let basis = products(degree, &across[n % width], &down[n / width]);
            for a in 0..terms {
                let weighted = weight * basis[a];
                for b in 0..=a {
                    normal[a][b] += weighted * basis[b];
                }
                for (right, raster) in right.iter_mut().zip(rasters) {
                    right[a] += weighted * f64::from(raster.values[n]);
                }
            }
        }
        let total = normal[0][0].max(1e-9);
        for (a, row) in normal.iter_mut().enumerate().take(terms) {
            // Regularisation: with wall on one side only, higher terms would be undetermined.
            row[a] += 1e-6 * total;
        }
        let coefficients = right.into_iter().map(|right| solve(&normal, right, terms)).collect();
        Polynomial { degree, width, height, coefficients }
    }

    /// Evaluates the polynomial of one raster at every pixel.
    fn raster(&self, which: usize) -> PixelRaster {
        let (across, down) = (legendre(self.width), legendre(self.height));
        let coefficients = &self.coefficients[which];
        PixelRaster::from_fn(self.width, self.height, |i, j| {
            let basis = products(self.degree, &across[i], &down[j]);
            basis.iter().zip(coefficients).map(|(basis, coefficient)| basis * coefficient).sum::<f64>() as f32
        })
    }
}

/// The Legendre polynomials of degree 0 to 4 at the middles of `count` pixels.
fn legendre(count: usize) -> Vec<[f64; 5]> {
    let at = |i: usize| {
        let x = (2.0 * i as f64 + 1.0) / count as f64 - 1.0;
        let (x2, x4) = (x * x, x * x * x * x);
        [1.0, x, 0.5 * (3.0 * x2 - 1.0), 0.5 * (5.0 * x2 - 3.0) * x, 0.125 * (35.0 * x4 - 30.0 * x2 + 3.0)]
    };
    (0..count).map(at).collect()
}

/// The basis functions of total degree at most `degree`; 0 beyond.
fn products(degree: usize, across: &[f64; 5], down: &[f64; 5]) -> [f64; MOST_TERMS] {
    let mut basis = [0.0; MOST_TERMS];
    let mut n = 0;
    for total in 0..=degree {
        for of_y in 0..=total {
            basis[n] = across[total - of_y] * down[of_y];
            n += 1;
        }
    }
    basis
}

/// Solves the normal equations (lower triangle) by Cholesky's decomposition.
fn solve(normal: &[[f64; MOST_TERMS]; MOST_TERMS], mut right: [f64; MOST_TERMS], terms: usize) -> [f64; MOST_TERMS] {
    let mut lower = *normal;
    for a in 0..terms {
        for b in 0..=a {
            let sum: f64 = (0..b).map(|k| lower[a][k] * lower[b][k]).sum();
            lower[a][b] =
                if a == b { (lower[a][a] - sum).max(1e-12).sqrt() } else { (lower[a][b] - sum) / lower[b][b] };
        }
    }
    for a in 0..terms {
        let sum: f64 = (0..a).map(|k| lower[a][k] * right[k]).sum();
        right[a] = (right[a] - sum) / lower[a][a];
    }
    for a in (0..terms).rev() {
        let sum: f64 = (a + 1..terms).map(|k| lower[k][a] * right[k]).sum();
        right[a] = (right[a] - sum) / lower[a][a];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quartic_is_found_again_around_a_hole() {
        let (width, height) = (60, 40);
        let z = |x: f64, y: f64| 0.3 - 0.5 * x + 0.2 * x * y + 0.7 * y * y - 0.4 * x * x * x * y + 0.3 * x * x * y * y;
        let raster = PixelRaster::from_fn(width, height, |i, j| {
            z((2 * i + 1) as f64 / 60.0 - 1.0, (2 * j + 1) as f64 / 40.0 - 1.0) as f32
        });
        let weight =
            |n: usize| if (20..40).contains(&(n % width)) && (12..28).contains(&(n / width)) { 0.0 } else { 1.0 };
        let weights: Vec<f64> = (0..width * height).map(weight).collect();
        let found = Polynomial::fit(4, width, height, &weights, &[&raster]).raster(0);
        let worst = found.values.iter().zip(&raster.values).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-3, "{worst}");
    }
}
