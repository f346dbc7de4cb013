//! Parses numbers quickly and with correct rounding.

/// Powers of ten that are exact in `f64`.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];
/// Whole numbers below this are exact in `f64`.
const EXACT: u64 = 1 << 53;

/// Parses a field; `nan`, `null` and an empty field give NaN, other text `None`.
///
/// Short decimals are digits divided by a power of ten: both are exact, so the quotient is correctly rounded
/// (Clinger 1990). All other fields go through the standard library.
pub(super) fn number(field: &[u8]) -> Option<f64> {
    short(field).or_else(|| other(field))
}

fn short(field: &[u8]) -> Option<f64> {
    let (negative, digits) = match field {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, field),
    };
    // 18 digits and a point: 18 digits fit into `u64`.
    if digits.is_empty() || digits.len() > 19 {
        return None;
    }
    let (mut whole, mut point) = (0u64, None);
    for (at, &byte) in digits.iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            whole = whole.wrapping_mul(10).wrapping_add(u64::from(digit));
        } else if byte == b'.' && point.is_none() {
            point = Some(at);
        } else {
            return None;
        }
    }
    if whole >= EXACT || digits.len() - usize::from(point.is_some()) > 18 {
        return None;
    }
    let value = match point {
        None => whole as f64,
        Some(_) if digits.len() == 1 => return None,
        Some(at) => whole as f64 / TENS[digits.len() - 1 - at],
    };
    Some(if negative { -value } else { value })
}

#[cold]
fn other(field: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(field).ok()?.trim();
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let is = |word: &&str| text.eq_ignore_ascii_case(word);
    let nothing = text.is_empty() || ["null", "none", "na", "n/a", "-nan", "-nan(ind)", "nan(ind)"].iter().any(is);
    nothing.then_some(f64::NAN)
}

/// Parses a timestamp (`2024-05-01T12:00:00.25Z`: seconds since 1970) or time of day, s.
pub(super) fn stamp(field: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(field).ok()?.trim();
    let (days, clock) = match text.split_once(['T', ' ']) {
        Some((date, clock)) => (days_since_1970(date)?, clock),
        None => (0, text),
    };
    let (clock, zone_s) = zone(clock)?;
    let mut parts = clock.split(':');
    let (hours, minutes) = (digits(parts.next()?)?, digits(parts.next()?)?);
    let seconds = number(parts.next()?.as_bytes()).filter(|s| (0.0..61.0).contains(s))?;
    if parts.next().is_some() || hours > 23 || minutes > 59 {
        return None;
    }
    Some((days * 86_400 + hours * 3600 + minutes * 60) as f64 - zone_s + seconds)
}

fn digits(text: &str) -> Option<i64> {
    (!text.is_empty() && text.len() <= 4 && text.bytes().all(|b| b.is_ascii_digit())).then(|| text.parse().ok())?
}

/// Splits a time of day from its zone; returns the zone's offset in seconds, positive if ahead.
fn zone(clock: &str) -> Option<(&str, f64)> {
    if let Some(clock) = clock.strip_suffix(['Z', 'z']) {
        return Some((clock.trim_end(), 0.0));
    }
    let Some(at) = clock.rfind(['+', '-']) else { return Some((clock, 0.0)) };
    let (clock, zone) = clock.split_at(at);
    let sign = if zone.starts_with('-') { -1.0 } else { 1.0 };
    let (hours, minutes) = match zone[1..].split_once(':') {
        Some((hours, minutes)) => (digits(hours)?, digits(minutes)?),
        None if zone.len() == 5 => (digits(zone.get(1..3)?)?, digits(zone.get(3..)?)?),
        None => (digits(&zone[1..])?, 0),
    };
    Some((clock, sign * (hours * 3600 + minutes * 60) as f64))
}

/// Days since 1970-01-01 (H. Hinnant, "chrono-compatible low-level date algorithms", 2013).
fn days_since_1970(date: &str) -> Option<i64> {
    let mut parts = date.split(['-', '/']);
    let (year, month, day) = (digits(parts.next()?)?, digits(parts.next()?)?, digits(parts.next()?)?);
    if parts.next().is_some() || !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let year_of_era = year.rem_euclid(400);
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    Some(era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719_468)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn decimals_are_rounded_as_the_standard_library_does(whole in any::<i64>(), decimals in 0usize..25, cut in 0u32..64) {
            let whole = whole >> cut;
            let digits = format!("{:0>1$}", whole.unsigned_abs(), decimals + 1);
            let (a, b) = digits.split_at(digits.len() - decimals);
            let text = format!("{}{a}.{b}", if whole < 0 { "-" } else { "" });
            prop_assert_eq!(number(text.as_bytes()).map(f64::to_bits), text.parse().ok().map(f64::to_bits), "{}", text);
        }

        #[test]
        fn any_field_is_what_the_standard_library_reads(text in "[-+0-9.eE]{0,22}") {
            let expected = if text.is_empty() { None } else { text.parse::<f64>().ok() };
            prop_assert_eq!(number(text.as_bytes()).filter(|v| !v.is_nan()), expected);
        }
    }

    #[test]
    fn words_for_nothing_are_no_numbers() {
        for word in ["", "nan", "NaN", "-nan(ind)", "null", "N/A", "  "] {
            assert!(number(word.as_bytes()).is_some_and(f64::is_nan), "{word}");
        }
        for word in ["x", "1,5", ".", "-", "1.2.3", "0x10", "1 2", "\u{661}"] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
        assert_eq!(number(b"inf"), Some(f64::INFINITY));
        assert_eq!(number(b"2.0400000e+02"), Some(204.0));
    }

    #[test]
    fn dates_and_times_of_day_are_seconds() {
        assert_eq!(stamp(b"1970-01-02T00:00:01.5Z"), Some(86_401.5));
        assert_eq!(stamp(b"2024-02-29 12:00:00"), Some(1_709_208_000.0));
        assert_eq!(stamp(b"2024-02-29T14:00:00+02:00"), Some(1_709_208_000.0));
        assert_eq!(stamp(b"01:02:03.25"), Some(3723.25));
        for bad in ["", "12", "12:61:00", "2024-13-01T00:00:00", "2024-01-01", "a:b:c", "2024-01-01T", "12:00:00+é9"] {
            assert_eq!(stamp(bad.as_bytes()), None, "{bad}");
        }
    }
}
