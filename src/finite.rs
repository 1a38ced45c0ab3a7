//! Finds a number that is not finite among the results of a run.

use serde::ser::{self, Serialize};
use std::fmt;

/// The place of the first number of `value` that is NaN or infinite, as the keys and indices that
/// lead to it: `walls.0.impact_power_w`; `None` where every number is finite.
///
/// Serde visits every number, so that a field added later is not forgotten.
pub(crate) fn first_not_finite(value: &impl Serialize) -> Option<String> {
    let mut visitor = Visitor { keys: Vec::new() };
    value.serialize(&mut visitor).is_err().then(|| visitor.keys.join("."))
}

/// Visits all numbers and stops at the first that is not finite, with the keys that lead to it.
struct Visitor {
    keys: Vec<String>,
}

impl Visitor {
    /// Visits `value` under `key`. After a number that is not finite the key stays.
    fn visit<T: Serialize + ?Sized>(&mut self, key: String, value: &T) -> Result<(), NotFinite> {
        self.keys.push(key);
        value.serialize(&mut *self)?;
        self.keys.pop();
        Ok(())
    }

    fn number(number: f64) -> Result<(), NotFinite> {
        if number.is_finite() { Ok(()) } else { Err(NotFinite) }
    }
}

/// The error that ends a visit.
#[derive(Debug)]
struct NotFinite;

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number is not finite")
    }
}

impl std::error::Error for NotFinite {}

impl ser::Error for NotFinite {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self
    }
}

/// The methods for values in which there is no number with a fraction.
macro_rules! pass {
    ($($method:ident($($type:ty),*);)*) => {
        $(fn $method(self, $(_: $type),*) -> Result<(), NotFinite> {
            Ok(())
        })*
    };
}

/// The methods for composite values.
macro_rules! composite {
    ($($method:ident($($type:ty),*);)*) => {
        $(fn $method(self, $(_: $type),*) -> Result<Parts<'a>, NotFinite> {
            Ok(Parts { visitor: self, next: 0 })
        })*
    };
}

/// Parts of a composite value, the place of each being its number.
struct Parts<'a> {
    visitor: &'a mut Visitor,
    next: usize,
}

impl Parts<'_> {
    fn part<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
        let key = self.next.to_string();
        self.next += 1;
        self.visitor.visit(key, value)
    }
}

impl<'a> ser::Serializer for &'a mut Visitor {
    type Ok = ();
    type Error = NotFinite;
    type SerializeSeq = Parts<'a>;
    type SerializeTuple = Parts<'a>;
    type SerializeTupleStruct = Parts<'a>;
    type SerializeTupleVariant = Parts<'a>;
    type SerializeMap = Parts<'a>;
    type SerializeStruct = Parts<'a>;
    type SerializeStructVariant = Parts<'a>;

    pass! {
        serialize_bool(bool);
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
        serialize_char(char);
        serialize_str(&str);
        serialize_bytes(&[u8]);
        serialize_none();
        serialize_unit();
        serialize_unit_struct(&'static str);
        serialize_unit_variant(&'static str, u32, &'static str);
    }

    composite! {
        serialize_seq(Option<usize>);
        serialize_tuple(usize);
        serialize_tuple_struct(&'static str, usize);
        serialize_tuple_variant(&'static str, u32, &'static str, usize);
        serialize_map(Option<usize>);
        serialize_struct(&'static str, usize);
        serialize_struct_variant(&'static str, u32, &'static str, usize);
    }

    fn serialize_f32(self, number: f32) -> Result<(), NotFinite> {
        Visitor::number(number.into())
    }

    fn serialize_f64(self, number: f64) -> Result<(), NotFinite> {
        Visitor::number(number)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result<(), NotFinite> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), NotFinite> {
        value.serialize(self)
    }
}

/// The traits of composite values whose parts have no names.
macro_rules! unnamed {
    ($($trait:ident::$method:ident),*) => {
        $(impl ser::$trait for Parts<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
                self.part(value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

unnamed!(
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field
);

/// The traits of composite values whose parts have names.
macro_rules! named {
    ($($trait:ident),*) => {
        $(impl ser::$trait for Parts<'_> {
            type Ok = ();
            type Error = NotFinite;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), NotFinite> {
                self.visitor.visit(key.to_owned(), value)
            }

            fn end(self) -> Result<(), NotFinite> {
                Ok(())
            }
        })*
    };
}

named!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Parts<'_> {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Result<(), NotFinite> {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotFinite> {
        self.part(value)
    }

    fn end(self) -> Result<(), NotFinite> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::first_not_finite;
    use serde::Serialize;

    #[derive(Serialize, Clone)]
    struct Wall {
        name: &'static str,
        law: Law,
        force: Option<[f64; 2]>,
    }

    #[derive(Serialize, Clone)]
    enum Law {
        Rigid,
        Elastic { stiffness: f64 },
    }

    #[test]
    fn a_number_that_is_not_finite_is_found_wherever_it_stands() {
        let sound = vec![
            Wall { name: "NaN", law: Law::Rigid, force: None },
            Wall { name: "inf", law: Law::Elastic { stiffness: 1e300 }, force: Some([0.0, -0.0]) },
        ];
        assert_eq!(first_not_finite(&sound), None);
        let found = |change: &dyn Fn(&mut Vec<Wall>)| {
            let mut walls = sound.clone();
            change(&mut walls);
            first_not_finite(&walls)
        };
        assert_eq!(found(&|walls| walls[1].force = Some([1.0, f64::NAN])).as_deref(), Some("1.force.1"));
        let soft = |walls: &mut Vec<Wall>| walls[0].law = Law::Elastic { stiffness: f64::NEG_INFINITY };
        assert_eq!(found(&soft).as_deref(), Some("0.law.stiffness"));
        assert_eq!(first_not_finite(&(1.0, Some(f64::INFINITY))).as_deref(), Some("1"));
        assert_eq!(first_not_finite(&None::<f64>), None);
    }
}
