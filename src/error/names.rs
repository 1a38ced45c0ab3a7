//! The names of an enum's values.

/// Gives an enum `ALL` of its values, in the order in which they are listed to users, the `name` of
/// each, and `Display`, which writes it; with words for what they are also `FromStr`:
///
/// ```ignore
/// names!(Backend: "QP solver", Auto => "auto", Clamp => "clamp");
/// ```
macro_rules! names {
    ($type:ident: $kind:literal, $($value:ident => $name:literal),+ $(,)?) => {
        crate::error::names!($type, $($value => $name),+);

        impl std::str::FromStr for $type {
            type Err = crate::error::Error;

            fn from_str(name: &str) -> std::result::Result<Self, Self::Err> {
                crate::error::named($kind, name, Self::ALL.map(|value| (value.name(), value)))
            }
        }
    };
    ($type:ident, $($value:ident => $name:literal),+ $(,)?) => {
        impl $type {
            /// All of them, in the order in which they are listed.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$value),+];

            /// Its name, as the tool, files and messages write it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $name),+
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }
    };
}

pub(crate) use names;
