//! Quantiles of a stream of numbers.

use std::collections::BTreeMap;

/// Bits of the fraction that select a bucket: buckets are 0.1 % wide.
const FRACTION_BITS: u32 = 10;

/// Histogram of positive numbers with buckets of relative width 0.1 %.
#[derive(Clone, Debug, Default)]
pub(super) struct Histogram {
    buckets: BTreeMap<u64, Bucket>,
    /// Cache of the last bucket, with counts not yet added to `buckets`: the next number often falls there too.
    latest: Option<(u64, Bucket)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Bucket {
    count: u64,
    sum: f64,
}

impl Histogram {
    #[inline]
    pub fn add(&mut self, value: f64) {
        if !(value > 0.0 && value.is_finite()) {
            return;
        }
        let key = value.to_bits() >> (52 - FRACTION_BITS);
        match &mut self.latest {
            Some((latest, bucket)) if *latest == key => bucket.add(1, value),
            _ => {
                self.settle();
                self.latest = Some((key, Bucket { count: 1, sum: value }));
            }
        }
    }

    fn settle(&mut self) {
        if let Some((key, bucket)) = self.latest.take() {
            self.buckets.entry(key).or_default().add(bucket.count, bucket.sum);
        }
    }

    /// Quantile at `share`, 0.5 for the median: the mean of its bucket.
    pub fn quantile(&mut self, share: f64) -> Option<f64> {
        self.settle();
        let total: u64 = self.buckets.values().map(|bucket| bucket.count).sum();
        let (mut below, wanted) = (0, share * total as f64);
        let found = self.buckets.values().find(|bucket| {
            below += bucket.count;
            below as f64 >= wanted
        });
        found.map(|bucket| bucket.sum / bucket.count as f64)
    }

    /// Number of values above `limit`, to 0.1 %.
    pub fn count_above(&mut self, limit: f64) -> u64 {
        self.settle();
        let above = self.buckets.values().filter(|bucket| bucket.sum / bucket.count as f64 > limit);
        above.map(|bucket| bucket.count).sum()
    }

    /// Sum of the values up to `limit`, to 0.1 %.
    pub fn sum_up_to(&mut self, limit: f64) -> f64 {
        self.settle();
        let below = self.buckets.values().filter(|bucket| bucket.sum / bucket.count as f64 <= limit);
        below.map(|bucket| bucket.sum).sum()
    }
}

impl Bucket {
    fn add(&mut self, count: u64, sum: f64) {
        self.count += count;
        self.sum += sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_numbers() {
        let mut histogram = Histogram::default();
        for k in 1..=999 {
            histogram.add(f64::from(k) * 0.01);
        }
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            histogram.add(bad);
        }
        assert!((histogram.quantile(0.5).unwrap() - 5.0).abs() < 0.01);
        assert!((histogram.quantile(0.75).unwrap() - 7.5).abs() < 0.01);
        assert_eq!(histogram.count_above(9.0), 99);
        assert!((histogram.sum_up_to(1.0) - 50.5).abs() < 1e-9);
        assert_eq!(Histogram::default().quantile(0.5), None);
    }

    #[test]
    fn equal_numbers_keep_their_value() {
        let mut histogram = Histogram::default();
        (0..5).for_each(|_| histogram.add(0.04));
        assert!((histogram.quantile(0.5).unwrap() - 0.04).abs() < 1e-15);
    }
}
