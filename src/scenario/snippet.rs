use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Longest piece of a source line that is shown, characters.
const LONGEST: usize = 96;

/// A place in a text file, and the line that it lies in unless that is kept back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snippet {
    /// The file.
    pub path: PathBuf,
    /// Line, from 1 on.
    pub line: usize,
    /// Column in characters, from 1 on.
    pub column: usize,
    /// The line's text, or the part of it around the place, on one row of a terminal; `None` where the file may be a wrong
    /// one, whose content is nobody's business.
    source: Option<String>,
    /// Where in `source` the carets begin, characters.
    caret: usize,
    /// How many carets.
    width: usize,
}

impl Snippet {
    /// The first line of a span of bytes.
    pub(super) fn of(path: &Path, text: &str, span: Range<usize>) -> Snippet {
        let start = text.floor_char_boundary(span.start.min(text.len()));
        let end = text.ceil_char_boundary(span.end.clamp(start, text.len()));
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |length| start + length);
        let column = text[line_start..start].chars().count();
        let width = text[start..end.min(line_end).max(start)].chars().count().max(1);

        let line: Vec<char> = text[line_start..line_end].trim_end().chars().map(one_cell).collect();
        let first = if column + width.min(20) > LONGEST { column.saturating_sub(LONGEST / 3) } else { 0 };
        let source: String = line.iter().skip(first).take(LONGEST).collect();
        Snippet {
            path: path.to_path_buf(),
            line: text[..start].matches('\n').count() + 1,
            column: column + 1,
            source: Some(source),
            caret: column - first,
            width: width.min(LONGEST - (column - first).min(LONGEST - 1)),
        }
    }
}

impl Snippet {
    /// The place alone.
    pub(super) fn without_line(self) -> Snippet {
        Snippet { source: None, ..self }
    }
}

/// Keeps tabs and control characters from moving the carets, or a terminal's cursor.
fn one_cell(c: char) -> char {
    if c == '\t' {
        ' '
    } else if c.is_control() {
        '\u{fffd}'
    } else {
        c
    }
}

impl fmt::Display for Snippet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Snippet { path, line, column, source, caret, width } = self;
        let number = line.to_string();
        let margin = " ".repeat(number.len());
        write!(f, "{margin}--> {}:{line}:{column}", path.display())?;
        let Some(source) = source else { return Ok(()) };
        writeln!(f)?;
        writeln!(f, "{margin} |")?;
        writeln!(f, "{number} | {source}")?;
        write!(f, "{margin} | {}{}", " ".repeat(*caret), "^".repeat(*width))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn show(text: &str, span: Range<usize>) -> String {
        Snippet::of(Path::new("a.toml"), text, span).to_string()
    }

    #[test]
    fn the_line_is_shown_with_carets_under_the_place() {
        let shown = show("[crowd]\npeople = 0 # none\n", 17..18);
        assert_eq!(shown, " --> a.toml:2:10\n  |\n2 | people = 0 # none\n  |          ^");
    }

    #[test]
    fn columns_are_characters_and_tabs_are_one_wide() {
        let shown = show("\té = 12\n", 6..8);
        assert_eq!(shown, " --> a.toml:1:6\n  |\n1 |  é = 12\n  |      ^^");
    }

    #[test]
    fn a_span_over_several_lines_shows_the_first() {
        let shown = show("a = [\n 1,\n]\n", 4..12);
        assert_eq!(shown, " --> a.toml:1:5\n  |\n1 | a = [\n  |     ^");
    }

    #[test]
    fn long_lines_are_cut_around_the_place() {
        let text = format!("a = \"{}\" b", "x".repeat(5000));
        let shown = show(&text, 5007..5008);
        assert!(shown.lines().all(|line| line.chars().count() < 110), "{shown}");
        assert!(shown.ends_with('^'));
        let wide = show(&text, 4..5006);
        assert!(wide.lines().all(|line| line.chars().count() < 110), "{wide}");
    }

    #[test]
    fn places_beyond_the_text_and_within_characters_do_not_panic() {
        for start in 0..12 {
            for end in 0..12 {
                show("é\u{1b}[31m\r\n", start..end);
            }
        }
        assert_eq!(show("", 0..0), " --> a.toml:1:1\n  |\n1 | \n  | ^");
    }
}
