//! A raster of numbers: means, blurs, reduction, quantiles.
//!
//! Not imageproc: its box filter sums in f32 and repeats border pixels; here sums are f64 over existing pixels.

/// A raster of values in image order, row 0 on top.
#[derive(Clone, Debug)]
pub(crate) struct PixelRaster {
    pub width: usize,
    pub height: usize,
    pub values: Vec<f32>,
}

impl PixelRaster {
    /// Evaluates a function of column and row at every pixel.
    pub fn from_fn(width: usize, height: usize, mut value: impl FnMut(usize, usize) -> f32) -> PixelRaster {
        let values = (0..width * height).map(|n| value(n % width, n / width)).collect();
        PixelRaster { width, height, values }
    }

    /// Applies a function to every value.
    pub fn map(&self, change: impl Fn(f32) -> f32) -> PixelRaster {
        let values = self.values.iter().map(|&value| change(value)).collect();
        PixelRaster { width: self.width, height: self.height, values }
    }

    /// Samples bilinearly between pixel centres (pixel (i, j) has its centre at (i + 0.5, j + 0.5)); clamps at the
    /// border.
    pub fn sample(&self, x: f64, y: f64) -> f32 {
        let along = |t: f64, count: usize| {
            let t = (t - 0.5).clamp(0.0, (count - 1) as f64);
            let low = (t as usize).min(count.saturating_sub(2));
            (low, (low + 1).min(count - 1), (t - low as f64) as f32)
        };
        let ((i, i_next, s), (j, j_next, t)) = (along(x, self.width), along(y, self.height));
        let at = |i: usize, j: usize| self.values[j * self.width + i];
        let top = at(i, j) + (at(i_next, j) - at(i, j)) * s;
        let bottom = at(i, j_next) + (at(i_next, j_next) - at(i, j_next)) * s;
        top + (bottom - top) * t
    }

    /// Reduces to the means over squares of `factor` pixels a side; drops a remainder at the right and the bottom.
    pub fn reduced(&self, factor: usize) -> PixelRaster {
        if factor <= 1 {
            return self.clone();
        }
        let area = (factor * factor) as f32;
        PixelRaster::from_fn(self.width / factor, self.height / factor, |i, j| {
            let row = |k: usize| &self.values[(j * factor + k) * self.width + i * factor..][..factor];
            (0..factor).map(|k| row(k).iter().sum::<f32>()).sum::<f32>() / area
        })
    }

    /// Box blur of `2 radius + 1` pixels a side, `passes` times; three passes are close to a Gaussian.
    ///
    /// At the border the mean is over the existing pixels.
    pub fn blurred(&self, radius: usize, passes: usize) -> PixelRaster {
        let mut blurred = self.clone();
        for _ in 0..passes {
            blurred = blurred.means_along_rows(radius).transposed().means_along_rows(radius).transposed();
        }
        blurred
    }

    fn means_along_rows(&self, radius: usize) -> PixelRaster {
        let mut values = Vec::with_capacity(self.values.len());
        let mut sums = vec![0.0f64; self.width + 1];
        for row in self.values.chunks_exact(self.width) {
            for (i, &value) in row.iter().enumerate() {
                sums[i + 1] = sums[i] + f64::from(value);
            }
            values.extend((0..self.width).map(|i| {
                let (from, to) = (i.saturating_sub(radius), (i + radius + 1).min(self.width));
                ((sums[to] - sums[from]) / (to - from) as f64) as f32
            }));
        }
        PixelRaster { width: self.width, height: self.height, values }
    }

    fn transposed(&self) -> PixelRaster {
        PixelRaster::from_fn(self.height, self.width, |i, j| self.values[i * self.width + j])
    }
}

/// Quantile of the values at `rank`, 0 to 1; 0 without values.
pub(crate) fn quantile(values: impl Iterator<Item = f32>, rank: f64) -> f64 {
    let mut values: Vec<f32> = values.collect();
    if values.is_empty() {
        return 0.0;
    }
    let place = ((values.len() - 1) as f64 * rank).round() as usize;
    f64::from(*values.select_nth_unstable_by(place, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blurring_keeps_a_plain_and_spreads_a_point() {
        let plain = PixelRaster::from_fn(20, 10, |_, _| 3.0).blurred(4, 3);
        assert!(plain.values.iter().all(|value| (value - 3.0).abs() < 1e-5));
        let point = PixelRaster::from_fn(21, 21, |i, j| if (i, j) == (10, 10) { 49.0 } else { 0.0 }).blurred(3, 1);
        assert_eq!((point.values[10 * 21 + 10], point.values[7 * 21 + 13], point.values[6 * 21 + 10]), (1.0, 1.0, 0.0));
    }

    #[test]
    fn a_slope_is_sampled_and_reduced_as_it_is() {
        let slope = PixelRaster::from_fn(12, 9, |i, j| i as f32 + 2.0 * j as f32);
        assert!((slope.sample(4.25, 3.0) - (3.75 + 5.0)).abs() < 1e-5);
        assert_eq!(slope.sample(-5.0, 0.0), 0.0);
        let reduced = slope.reduced(3);
        assert_eq!((reduced.width, reduced.height, reduced.values[5]), (4, 3, 4.0 + 2.0 * 4.0));
        assert_eq!(PixelRaster::from_fn(1, 1, |_, _| 7.0).sample(9.0, -1.0), 7.0);
    }

    #[test]
    fn quantiles_of_few_and_of_none() {
        assert_eq!(quantile([3.0, 1.0, 2.0].into_iter(), 0.5), 2.0);
        assert_eq!(quantile([3.0, 1.0, 2.0].into_iter(), 1.0), 3.0);
        assert_eq!(quantile(std::iter::empty(), 0.5), 0.0);
    }
}
