use std::fmt;

/// Range of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// Whether `high` itself is beyond.
    pub open: bool,
}

impl Limits {
    /// Whether a number is within; NaN is not.
    pub fn hold(&self, number: f64) -> bool {
        number >= self.low && number <= self.high && !(self.open && number == self.high)
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Limits { low, high, open } = self;
        if *open { write!(f, "at least {low}, and less than {high}") } else { write!(f, "{low} to {high}") }
    }
}

/// What a key takes.
#[derive(Clone)]
pub(crate) enum Kind {
    /// Any number.
    Number,
    /// A whole number, at least and at most.
    Whole(i64, i64),
    /// True or false.
    Truth,
    /// A text.
    Text,
    /// One of these names.
    OneOf(&'static [&'static str]),
    /// A list, of a fixed length where there is one.
    List(Box<Kind>, Option<usize>),
    /// Keys of its own.
    Table(Table),
    /// Any of these; in words for messages.
    AnyOf(&'static str, Vec<Kind>),
}

/// A table of keys.
#[derive(Clone, Copy)]
pub(crate) struct Table {
    /// Name of the struct.
    pub name: &'static str,
    /// Its fields, in order.
    pub parts: &'static [&'static [Field]],
}

/// The key of a field: `use` of `r#use`.
pub(crate) const fn key(field: &'static str) -> &'static str {
    match field.as_bytes() {
        [b'r', b'#', ..] => field.split_at(2).1,
        _ => field,
    }
}

/// A key, as it was declared.
pub(crate) struct Field {
    /// Name.
    pub name: &'static str,
    /// Lines of its doc comment.
    pub docs: &'static [&'static str],
    /// What it takes.
    pub kind: fn() -> Kind,
    /// What it is if nobody writes it; `None` where it is left out.
    pub default: fn() -> Option<toml::Value>,
    /// Range of each number in it.
    pub limits: Option<Limits>,
    /// Unit, as in `m/s`.
    pub unit: &'static str,
    /// What it looks like, where the default does not show it. Tables with an example are written on one line.
    pub example: &'static str,
    /// Whether it has no default.
    pub required: bool,
}

impl Table {
    /// All fields, in order.
    pub fn fields(&self) -> impl Iterator<Item = &'static Field> + use<> {
        self.parts.iter().copied().flatten()
    }
}

impl Field {
    /// A key of a small table, such as `px`.
    pub const fn plain(name: &'static str, kind: fn() -> Kind, required: bool) -> Field {
        Field { name, docs: &[], kind, default: || None, limits: None, unit: "", example: "", required }
    }

    /// The first paragraph of its doc comment, on one line, with its unit.
    pub fn about(&self) -> String {
        let lines: Vec<&str> = self.docs.iter().map(|line| line.trim()).take_while(|line| !line.is_empty()).collect();
        let text = lines.join(" ");
        let text = text.strip_suffix('.').unwrap_or(&text);
        match (self.unit, text.split_once("; ")) {
            ("", _) => text.to_string(),
            (unit, None) => format!("{text} [{unit}]"),
            (unit, Some((what, more))) => format!("{what} [{unit}]; {more}"),
        }
    }

    /// The keys of its own that are a section of a file: a table or, with `true`, a list of tables; not if written on one
    /// line.
    pub fn section(&self) -> Option<(Table, bool)> {
        match (self.kind)() {
            _ if !self.example.is_empty() => None,
            Kind::Table(table) => Some((table, false)),
            Kind::List(kind, _) => match *kind {
                Kind::Table(table) => Some((table, true)),
                _ => None,
            },
            _ => None,
        }
    }
}

impl Kind {
    /// What may be written, for messages.
    pub fn in_words(&self) -> String {
        match self {
            Kind::Number => "a number".to_string(),
            Kind::Whole(low, high) if *high <= 255 => format!("a whole number from {low} to {high}"),
            Kind::Whole(..) => "a whole number of 0 or more".to_string(),
            Kind::Truth => "true or false".to_string(),
            Kind::Text => "a text in quotes".to_string(),
            Kind::OneOf(names) => format!("one of {}", names.join(", ")),
            Kind::List(_, Some(2)) => "two numbers in brackets".to_string(),
            Kind::List(_, Some(3)) => "three numbers in brackets".to_string(),
            Kind::List(_, Some(count)) => format!("a list of {count} numbers in brackets"),
            Kind::List(_, None) => "a list in [brackets]".to_string(),
            Kind::Table(_) => "a table of keys".to_string(),
            Kind::AnyOf(words, _) => (*words).to_string(),
        }
    }

    /// The tables that it may be written as.
    pub fn tables(&self) -> Vec<Table> {
        match self {
            Kind::Table(table) => vec![*table],
            Kind::AnyOf(_, kinds) => kinds.iter().flat_map(Kind::tables).collect(),
            _ => Vec::new(),
        }
    }
}
