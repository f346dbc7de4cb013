/// Declares a struct of options. A field is `name: type = default`, then, each if there is one: its range `in 0.0..=1.0`,
/// its `unit "m"`, an example `eg "[1, 2]"`, and `required true` where the default stands for nothing. The first
/// paragraph of its doc comment explains the key to users. What follows `with` are fields that are no keys.
macro_rules! options {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $(
                $(#[doc = $doc:literal])*
                $field:ident: $type:ty = $default:expr
                    $(, in $low:literal $(..= $high:literal)? $(.. $below:literal)?)?
                    $(, unit $unit:literal)? $(, eg $example:literal)? $(, required $required:literal)?;
            )*
        }
        $(with { $($(#[doc = $own_doc:literal])* $own:ident: $own_type:ty = $own_default:expr;)* })?
    ) => {
        $(#[$meta])*
        // Explanations name sections as TOML does, `[formation]`: these are no links.
        #[allow(rustdoc::broken_intra_doc_links)]
        #[derive(Clone, Debug, PartialEq)]
        $vis struct $name {
            $(
                $(#[doc = $doc])*
                #[doc = concat!(
                    "\n\n", $("Range ", stringify!($low), $("..=", stringify!($high),)? $("..", stringify!($below),)? "; ",)?
                    $("unit ", $unit, "; ",)? "default `", stringify!($default), "`."
                )]
                pub $field: $type,
            )*
            $($($(#[doc = $own_doc])* pub $own: $own_type,)*)?
        }

        impl Default for $name {
            fn default() -> $name {
                $name { $($field: $default,)* $($($own: $own_default,)*)? }
            }
        }

        impl $crate::options::Options for $name {
            const TABLE: $crate::options::Table = $crate::options::Table {
                name: stringify!($name),
                parts: &[&[$($crate::options::Field {
                    name: $crate::options::key(stringify!($field)),
                    docs: &[$($doc),*],
                    kind: <$type as $crate::options::Value>::kind,
                    default: || <$type as $crate::options::Value>::write(&$default),
                    limits: options!(@limits $($low $(, $high, false)? $(, $below, true)?)?),
                    unit: concat!($($unit)?),
                    example: concat!($($example)?),
                    required: false $(|| $required)?,
                }),*]],
            };

            fn values(&self) -> Vec<&dyn $crate::options::Value> {
                vec![$(&self.$field),*]
            }

            fn values_mut(&mut self) -> Vec<&mut dyn $crate::options::Value> {
                vec![$(&mut self.$field),*]
            }
        }

        impl $crate::options::Value for $name {
            fn kind() -> $crate::options::Kind {
                $crate::options::Kind::Table(<$name as $crate::options::Options>::TABLE)
            }

            fn of(value: &$crate::options::Spot<'_>) -> Result<$name, $crate::options::Mistake> {
                $crate::options::Options::complete(value)
            }

            fn read(&mut self, value: &$crate::options::Spot<'_>) -> Result<(), $crate::options::Mistake> {
                $crate::options::Options::lay(self, value)
            }

            fn write(&self) -> Option<toml::Value> {
                Some(toml::Value::Table($crate::options::Options::table(self)))
            }

            fn check(&self, _: Option<$crate::options::Limits>) -> Result<(), $crate::options::OptionError> {
                $crate::options::Options::check_ranges(self)
            }
        }
    };
    (@limits) => { None };
    (@limits $low:literal, $high:literal, $open:literal) => {
        Some($crate::options::Limits { low: $low as f64, high: $high as f64, open: $open })
    };
}

pub(crate) use options;
