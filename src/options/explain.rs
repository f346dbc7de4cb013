use super::field::Kind;
use super::read::{Mistake, Problem};

/// A message and what to do about it.
pub(crate) type Explanation = (String, Option<String>);

impl Mistake {
    /// What is wrong, for a reader who sees where; `text` is the file that it is in.
    pub fn explain(&self, text: &str) -> Explanation {
        let found = text.get(self.span.clone()).unwrap_or("");
        match &self.problem {
            Problem::Syntax(message) => (format!("not valid TOML: {message}"), None),
            Problem::Missing(name) => (format!("`{name}` is missing in {}", heading(&self.path)), None),
            Problem::UnknownKey(name, known) => {
                let hint = match nearest(name, known.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("its keys are {}", known.join(", ")),
                };
                (format!("{} has no key `{name}`", heading(&self.path)), Some(hint))
            }
            Problem::Unlike(kind) => {
                let key = self.path.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or_default();
                match kind {
                    Kind::OneOf(names) if found.starts_with(['"', '\'']) => {
                        let near = nearest(found.trim_matches(['"', '\'']), names.iter().copied());
                        let message = format!("`{key}` cannot be {}; it is {}", shortened(found), kind.in_words());
                        (message, near.map(|near| format!("did you mean \"{near}\"?")))
                    }
                    _ => (format!("`{key}` takes {}, not {}", kind.in_words(), shortened(found)), None),
                }
            }
        }
    }
}

/// A table as a file writes it: `[look.film]`, `[[route]]`.
pub(crate) fn heading(path: &str) -> String {
    let names: Vec<&str> = path.split('.').filter(|part| part.parse::<usize>().is_err()).collect();
    let is_entry = path.rsplit('.').next().is_some_and(|last| last.parse::<usize>().is_ok());
    match names.join(".") {
        name if name.is_empty() => "the file".to_string(),
        name if is_entry => format!("[[{name}]]"),
        name => format!("[{name}]"),
    }
}

/// The name that `found` was most likely meant to be, if any is near.
pub(crate) fn nearest<'k>(found: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let limit = (found.chars().count() / 3).clamp(1, 4);
    known
        .map(|name| (strsim::damerau_levenshtein(&found.to_lowercase(), name), name))
        .filter(|&(distance, _)| distance <= limit)
        .min()
        .map(|(_, name)| name)
}

/// A value as it stands in the file, on one line and not too long.
fn shortened(found: &str) -> String {
    let line = found.lines().next().unwrap_or("");
    let cut = line.chars().count() > 40 || found.lines().count() > 1;
    let mut shown: String = line.chars().filter(|c| !c.is_control()).take(40).collect();
    if cut {
        shown.push_str(" ...");
    }
    shown
}
