use std::path::PathBuf;

use serde::de::{DeserializeOwned, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::error::OptionError;
use super::field::{Field, Kind, Limits, Table};
use super::read::{Mistake, Problem, Spot};

/// What a key holds.
pub(crate) trait Value {
    /// What it takes.
    fn kind() -> Kind
    where
        Self: Sized;
    /// Reads a value.
    fn of(value: &Spot<'_>) -> Result<Self, Mistake>
    where
        Self: Sized;
    /// Reads a value over this one: of a table, only the keys that it writes.
    fn read(&mut self, value: &Spot<'_>) -> Result<(), Mistake>;
    /// The value; `None` where it is left out.
    fn write(&self) -> Option<toml::Value>;
    /// Checks every number in it.
    fn check(&self, limits: Option<Limits>) -> Result<(), OptionError>;
}

/// A struct of options; [`options!`](super::options) makes it.
pub(crate) trait Options: Default {
    /// Its fields.
    const TABLE: Table;
    /// Its values, in the order of the fields.
    fn values(&self) -> Vec<&dyn Value>;
    /// Its values, in the order of the fields.
    fn values_mut(&mut self) -> Vec<&mut dyn Value>;

    /// Fields with their values.
    fn parts(&self) -> impl Iterator<Item = (&'static Field, &dyn Value)> {
        Self::TABLE.fields().zip(self.values())
    }

    /// Reads a table that has all that is required.
    fn complete(value: &Spot<'_>) -> Result<Self, Mistake> {
        let mut options = Self::default();
        options.lay(value)?;
        let written = |field: &Field| value.get_ref().as_table().is_some_and(|table| table.contains_key(field.name));
        match Self::TABLE.fields().find(|field| field.required && !written(field)) {
            Some(field) => Err(Mistake::new(value, Problem::Missing(field.name))),
            None => Ok(options),
        }
    }

    /// Reads a table over these options.
    fn lay(&mut self, value: &Spot<'_>) -> Result<(), Mistake> {
        match value.get_ref() {
            DeValue::Table(table) => read_parts(Self::TABLE.fields().zip(self.values_mut()), table),
            _ => Err(Mistake::new(value, Problem::Unlike(Kind::Table(Self::TABLE)))),
        }
    }

    /// All values as a table.
    fn table(&self) -> toml::Table {
        write_parts(self.parts())
    }

    /// Checks every value against its range.
    fn check_ranges(&self) -> Result<(), OptionError> {
        check_parts(self.parts())
    }
}

/// Reads the keys of a table over values that are there.
pub(crate) fn read_parts<'v>(
    parts: impl IntoIterator<Item = (&'static Field, &'v mut dyn Value)>,
    table: &DeTable<'_>,
) -> Result<(), Mistake> {
    let mut parts: Vec<_> = parts.into_iter().collect();
    for (name, value) in table.iter() {
        let key = name.get_ref().as_ref();
        let Some((field, own)) = parts.iter_mut().find(|(field, _)| field.name == key) else {
            let known = parts.iter().map(|(field, _)| field.name).collect();
            let problem = Problem::UnknownKey(key.to_string(), known);
            return Err(Mistake { span: name.span(), path: String::new(), problem });
        };
        own.read(value).map_err(|mistake| mistake.within(field.name))?;
    }
    Ok(())
}

/// The keys as a table; those that are left out or empty where an example shows what they take are not written.
pub(crate) fn write_parts<'v>(parts: impl IntoIterator<Item = (&'static Field, &'v dyn Value)>) -> toml::Table {
    let written = |(field, value): (&'static Field, &dyn Value)| {
        let value = value.write()?;
        let is_empty = match &value {
            toml::Value::Array(items) => items.is_empty(),
            toml::Value::Table(table) => table.is_empty(),
            _ => false,
        };
        let left_out = is_empty && (!field.example.is_empty() || field.section().is_some());
        (!left_out).then(|| (field.name.to_string(), value))
    };
    parts.into_iter().filter_map(written).collect()
}

/// Checks values against their ranges.
///
/// # Errors
/// The first that is out of its range.
pub(crate) fn check_parts<'v>(
    parts: impl IntoIterator<Item = (&'static Field, &'v dyn Value)>,
) -> Result<(), OptionError> {
    parts.into_iter().try_for_each(|(field, value)| value.check(field.limits).map_err(|error| error.within(field.name)))
}

/// Reads options from TOML; what it leaves out keeps its default.
///
/// # Errors
/// The first key or value that cannot be read.
pub(crate) fn parse<T: Options>(text: &str) -> Result<T, Mistake> {
    let table = DeTable::parse(text).map_err(|error| Mistake::syntax(&error))?;
    let span = table.span();
    T::complete(&Spanned::new(span, DeValue::Table(table.into_inner())))
}

/// Options within what serde keeps, for `#[serde(with)]`: as a table.
pub(crate) mod kept {
    use super::*;

    pub fn serialize<T: Options, S: Serializer>(options: &Option<T>, serializer: S) -> Result<S::Ok, S::Error> {
        options.as_ref().map(Options::table).serialize(serializer)
    }

    pub fn deserialize<'de, T: Options, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
        let Some(table) = Option::<toml::Table>::deserialize(deserializer)? else { return Ok(None) };
        let text = table.to_string();
        parse(&text).map(Some).map_err(|mistake| serde::de::Error::custom(mistake.explain(&text).0))
    }
}

/// A value that serde reads and writes.
pub(crate) trait Leaf: Serialize + DeserializeOwned {
    /// What it takes.
    fn takes() -> Kind;

    /// Checks the numbers in it.
    fn check_numbers(&self, _: Limits) -> Result<(), OptionError> {
        Ok(())
    }

    /// The value to write.
    fn written(&self) -> Option<toml::Value> {
        toml::Value::try_from(self).ok()
    }
}

impl<T: Leaf> Value for T {
    fn kind() -> Kind {
        T::takes()
    }

    fn of(value: &Spot<'_>) -> Result<T, Mistake> {
        let kind = T::takes();
        let known: Vec<&str> = kind.tables().iter().flat_map(Table::fields).map(|field| field.name).collect();
        if let DeValue::Table(written) = value.get_ref()
            && !known.is_empty()
            && let Some((name, _)) = written.iter().find(|(name, _)| !known.contains(&name.get_ref().as_ref()))
        {
            let problem = Problem::UnknownKey(name.get_ref().to_string(), known);
            return Err(Mistake { span: name.span(), path: String::new(), problem });
        }
        T::deserialize(ValueDeserializer::from(value.clone())).map_err(|error| {
            let span = error.span().unwrap_or(value.span());
            Mistake { span, path: String::new(), problem: Problem::Unlike(kind) }
        })
    }

    fn read(&mut self, value: &Spot<'_>) -> Result<(), Mistake> {
        *self = T::of(value)?;
        Ok(())
    }

    fn write(&self) -> Option<toml::Value> {
        self.written()
    }

    fn check(&self, limits: Option<Limits>) -> Result<(), OptionError> {
        limits.map_or(Ok(()), |limits| self.check_numbers(limits))
    }
}

impl<T: Value> Value for Option<T> {
    fn kind() -> Kind {
        T::kind()
    }

    fn of(value: &Spot<'_>) -> Result<Option<T>, Mistake> {
        T::of(value).map(Some)
    }

    fn read(&mut self, value: &Spot<'_>) -> Result<(), Mistake> {
        *self = Some(T::of(value)?);
        Ok(())
    }

    fn write(&self) -> Option<toml::Value> {
        self.as_ref()?.write()
    }

    fn check(&self, limits: Option<Limits>) -> Result<(), OptionError> {
        self.as_ref().map_or(Ok(()), |value| value.check(limits))
    }
}

impl<T: Value> Value for Vec<T> {
    fn kind() -> Kind {
        Kind::List(Box::new(T::kind()), None)
    }

    fn of(value: &Spot<'_>) -> Result<Vec<T>, Mistake> {
        let DeValue::Array(items) = value.get_ref() else {
            return Err(Mistake::new(value, Problem::Unlike(Self::kind())));
        };
        let read = |(index, item)| T::of(item).map_err(|mistake: Mistake| mistake.within(&format!("{index}")));
        items.iter().enumerate().map(read).collect()
    }

    fn read(&mut self, value: &Spot<'_>) -> Result<(), Mistake> {
        *self = Self::of(value)?;
        Ok(())
    }

    fn write(&self) -> Option<toml::Value> {
        Some(toml::Value::Array(self.iter().filter_map(Value::write).collect()))
    }

    fn check(&self, limits: Option<Limits>) -> Result<(), OptionError> {
        check_items(self, limits)
    }
}

impl<T: Value, const N: usize> Value for [T; N] {
    fn kind() -> Kind {
        Kind::List(Box::new(T::kind()), Some(N))
    }

    fn of(value: &Spot<'_>) -> Result<[T; N], Mistake> {
        let unlike = |_| Mistake::new(value, Problem::Unlike(Self::kind()));
        Vec::<T>::of(value)
            .map_err(|mistake| if mistake.path.is_empty() { unlike(()) } else { mistake })?
            .try_into()
            .map_err(|_| unlike(()))
    }

    fn read(&mut self, value: &Spot<'_>) -> Result<(), Mistake> {
        *self = Self::of(value)?;
        Ok(())
    }

    fn write(&self) -> Option<toml::Value> {
        Some(toml::Value::Array(self.iter().filter_map(Value::write).collect()))
    }

    fn check(&self, limits: Option<Limits>) -> Result<(), OptionError> {
        check_items(self, limits)
    }
}

fn check_items<T: Value>(items: &[T], limits: Option<Limits>) -> Result<(), OptionError> {
    let check = |(index, item): (usize, &T)| item.check(limits).map_err(|error| error.within(&index.to_string()));
    items.iter().enumerate().try_for_each(check)
}

macro_rules! numbers {
    ($($type:ty: $kind:expr, $to_f64:expr;)*) => {$(
        impl Leaf for $type {
            fn takes() -> Kind {
                $kind
            }

            fn check_numbers(&self, limits: Limits) -> Result<(), OptionError> {
                let number = $to_f64(*self);
                if limits.hold(number) { Ok(()) } else { Err(OptionError::beyond(number, limits)) }
            }
        }
    )*};
}

numbers! {
    f64: Kind::Number, |number| number;
    u8: Kind::Whole(0, 255), f64::from;
    u32: Kind::Whole(0, i64::from(u32::MAX)), f64::from;
    u64: Kind::Whole(0, i64::MAX), |number| number as f64;
}

impl Leaf for f32 {
    fn takes() -> Kind {
        Kind::Number
    }

    fn check_numbers(&self, limits: Limits) -> Result<(), OptionError> {
        shortest(*self).check_numbers(limits)
    }

    fn written(&self) -> Option<toml::Value> {
        Some(toml::Value::Float(shortest(*self)))
    }
}

/// The decimal that was meant: 0.38, not 0.3799999952316284.
pub(crate) fn shortest(number: f32) -> f64 {
    number.to_string().parse().unwrap_or(f64::from(number))
}

impl Leaf for bool {
    fn takes() -> Kind {
        Kind::Truth
    }
}

impl Leaf for String {
    fn takes() -> Kind {
        Kind::Text
    }
}

impl Leaf for PathBuf {
    fn takes() -> Kind {
        Kind::Text
    }
}

/// Makes enums without data values of options: by their names in serde.
macro_rules! names {
    ($($type:ty),*) => {$(
        impl $crate::options::Leaf for $type {
            fn takes() -> $crate::options::Kind {
                $crate::options::Kind::OneOf($crate::options::names_of::<$type>())
            }
        }
    )*};
}

pub(crate) use names;

/// Names of an enum's variants, as serde reads them.
pub(crate) fn names_of<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut names: &'static [&'static str] = &[];
    // The probe refuses; what counts is the question.
    let _ = T::deserialize(Probe(&mut names));
    names
}

/// A deserializer that notes which names an enum has.
struct Probe<'n>(&'n mut &'static [&'static str]);

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = serde::de::value::Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
        Err(serde::de::Error::custom("no enum"))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Self::Error> {
        *self.0 = names;
        Err(serde::de::Error::custom("noted"))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}
