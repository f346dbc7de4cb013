use super::Frame;
use super::resampler::FASTEST_M_S;

/// Total walking distance and presence of all people.
#[derive(Clone, Debug, Default)]
pub struct Mileage {
    metres: f64,
    person_seconds: f64,
    last: Frame,
}

impl Mileage {
    /// Takes the motion's next frame.
    pub fn push(&mut self, frame: &Frame) {
        let step_s = frame.time_s - self.last.time_s;
        let mut before = self.last.walkers.iter().peekable();
        for walker in &frame.walkers {
            while before.next_if(|other| other.id < walker.id).is_some() {}
            let Some(earlier) = before.next_if(|other| other.id == walker.id) else { continue };
            let step_m = walker.position_m.distance(earlier.position_m);
            if step_m <= FASTEST_M_S * step_s {
                self.metres += step_m;
                self.person_seconds += step_s;
            }
        }
        self.last.time_s = frame.time_s;
        self.last.walkers.clone_from(&frame.walkers);
    }

    /// Total walking distance, metres.
    pub fn metres(&self) -> f64 {
        self.metres
    }

    /// Total presence, person-seconds.
    pub fn person_seconds(&self) -> f64 {
        self.person_seconds
    }

    /// Mean walking speed, metres per person-second; 0 without people.
    pub fn mean_speed_m_s(&self) -> f64 {
        if self.person_seconds > 0.0 { self.metres / self.person_seconds } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2;
    use crate::motion::Walker;

    #[test]
    fn everybody_counts_while_present() {
        let walker = |id, x| Walker { id, position_m: vec2(x, 0.0), velocity_m_s: vec2(9.0, 9.0), heading: None };
        let mut mileage = Mileage::default();
        for (time_s, walkers) in [
            (0.5, vec![walker(3, 0.0)]),
            (1.0, vec![walker(1, 0.0), walker(3, 1.0)]),
            (1.5, vec![walker(1, 0.25), walker(3, 100.0)]),
            (2.0, vec![walker(3, 100.0)]),
        ] {
            mileage.push(&Frame { time_s, walkers });
        }
        assert_eq!((mileage.metres(), mileage.person_seconds()), (1.25, 1.5));
        assert_eq!(mileage.mean_speed_m_s(), 1.25 / 1.5);
        assert_eq!(Mileage::default().mean_speed_m_s(), 0.0);
    }
}
