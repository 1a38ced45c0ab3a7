//! Steps between two contacts are judged and recorded many at once: with the results that they have
//! one by one.

use crate::support::Seeds;
