//! The pairs of group code and value of a DXF file, as text or binary.

use crate::plan::vector::format::BINARY_DXF;

/// A group code and its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pair<'a> {
    pub(super) code: i32,
    pub(super) value: Value<'a>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value<'a> {
    Text(&'a str),
    Number(f64),
}

impl<'a> Pair<'a> {
    pub(super) fn text(&self) -> &'a str {
        match self.value {
            Value::Text(text) => text,
            Value::Number(_) => "",
        }
    }

    pub(super) fn number(&self) -> f64 {
        match self.value {
            Value::Text(text) => text.parse().unwrap_or(0.0),
            Value::Number(number) => number,
        }
    }

    pub(super) fn is(&self, code: i32, text: &str) -> bool {
        self.code == code && self.text() == text
    }
}

/// Text of a file in UTF-8, or else in the western code page that older programs write.
pub(super) fn decode(bytes: &[u8]) -> String {
    if bytes.starts_with(BINARY_DXF) {
        return String::new();
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
    }
}

/// All pairs of a file; `text` is its decoded text.
pub(super) fn pairs<'a>(bytes: &'a [u8], text: &'a str) -> Result<Vec<Pair<'a>>, String> {
    match bytes.strip_prefix(BINARY_DXF) {
        Some(body) => binary(body),
        None => lines(text),
    }
}

fn lines(text: &str) -> Result<Vec<Pair<'_>>, String> {
    let mut pairs = Vec::new();
    let mut lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    while let Some((at, line)) = lines.next() {
        let line = line.trim();
        let Ok(code) = line.parse() else {
            // Empty lines at the end.
            if line.is_empty() && lines.all(|(_, rest)| rest.trim().is_empty()) {
                break;
            }
            return Err(format!("line {} should be a group code, it is {line:.20?}", at + 1));
        };
        let Some((_, value)) = lines.next() else {
            return Err(format!("it ends after the group code in line {}: it was cut off", at + 1));
        };
        pairs.push(Pair { code, value: Value::Text(value.trim()) });
    }
    Ok(pairs)
}

fn binary(mut body: &[u8]) -> Result<Vec<Pair<'_>>, String> {
    fn take<'a>(body: &mut &'a [u8], count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = body.split_at_checked(count).ok_or("it was cut off")?;
        *body = rest;
        Ok(taken)
    }
    let mut pairs = Vec::new();
    while !body.is_empty() {
        let code = take(&mut body, 2)?;
        let code = i32::from(i16::from_le_bytes([code[0], code[1]]));
        let value = match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                Value::Number(f64::from_le_bytes(take(&mut body, 8)?.try_into().unwrap_or_default()))
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                let b = take(&mut body, 2)?;
                Value::Number(f64::from(i16::from_le_bytes([b[0], b[1]])))
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => {
                Value::Number(f64::from(i32::from_le_bytes(take(&mut body, 4)?.try_into().unwrap_or_default())))
            }
            160..=169 => Value::Number(i64::from_le_bytes(take(&mut body, 8)?.try_into().unwrap_or_default()) as f64),
            290..=299 => Value::Number(f64::from(take(&mut body, 1)?[0])),
            310..=319 | 1004 => {
                let length = usize::from(take(&mut body, 1)?[0]);
                take(&mut body, length)?;
                Value::Text("")
            }
            _ => {
                let end = memchr::memchr(0, body).ok_or("a text in it has no end: it was cut off")?;
                let text = std::str::from_utf8(take(&mut body, end)?).unwrap_or("");
                take(&mut body, 1)?;
                Value::Text(text)
            }
        };
        pairs.push(Pair { code, value });
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_binary_give_the_same_pairs() {
        let text = pairs(b"", "  0\nSECTION\n 10\n1.5\n 70\n1\n").unwrap();
        let mut bytes = BINARY_DXF.to_vec();
        bytes.extend([0, 0]);
        bytes.extend(b"SECTION\0");
        bytes.extend([10, 0]);
        bytes.extend(1.5f64.to_le_bytes());
        bytes.extend([70, 0, 1, 0]);
        let binary = pairs(&bytes, "").unwrap();
        assert_eq!(text.len(), 3);
        assert!(text.iter().zip(&binary).all(|(a, b)| a.code == b.code && a.number() == b.number()));
        assert!(pairs(&bytes[..bytes.len() - 1], "").is_err());
        assert!(pairs(b"", "0\nSECTION\n10\n").unwrap_err().contains("cut off"));
        assert!(pairs(b"", "zero\nSECTION\n").unwrap_err().contains("line 1"));
    }
}
