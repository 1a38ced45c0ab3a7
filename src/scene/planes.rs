//! Structures that move in two planes, and directions in their cross-section.

use super::{Row, Structure};
use crate::linear::Symmetric;
use serde::{Deserialize, Serialize};

/// The unit vector (cos α, sin α) of the direction α in degrees, from +y towards +z. Multiples of
/// 90° are exact, so that a direction along an axis has no component in the other plane.
#[must_use]
pub fn heading(degrees: f64) -> [f64; 2] {
    let turn = degrees.rem_euclid(360.0);
    match turn {
        0.0 | 360.0 => [1.0, 0.0],
        90.0 => [0.0, 1.0],
        180.0 => [-1.0, 0.0],
        270.0 => [0.0, -1.0],
        _ => {
            let (sin, cos) = turn.to_radians().sin_cos();
            [cos, sin]
        }
    }
}

impl Structure {
    /// The structure in two uncoupled planes: diag(M, M), diag(C, C), diag(K, K). Its 2n degrees of
    /// freedom are the n of this structure in the plane y, then the n in the plane z.
    #[must_use]
    pub fn in_two_planes(&self) -> Self {
        Self::uncoupled(&[self, self])
    }

    /// Several structures as one, which only walls couple: the degrees of freedom of the first,
    /// then those of the second, and so on.
    ///
    /// ```
    /// use signorini::{Row, Scene, Structure, Wall};
    ///
    /// // Two carts of 1 kg and 3 kg, 0.5 m apart: the first may not pass the second.
    /// let cart = |mass: f64| Scene::oscillator(mass, 0.0, 0.0).system.structure();
    /// let carts = Structure::uncoupled(&[&cart(1.0), &cart(3.0)]);
    /// let touch = Wall::upper("touch", 0.5).at(Row::new(vec![(0, 1.0), (1, -1.0)]));
    /// assert_eq!(Scene::structure(carts).with_wall(touch).wall_masses(), [0.75]);
    /// ```
    #[must_use]
    pub fn uncoupled(bodies: &[&Self]) -> Self {
        let joined = |matrix: fn(&Self) -> &Symmetric| {
            let (mut n, mut entries) = (0, Vec::new());
            for body in bodies {
                entries.extend(matrix(body).entries().map(|(i, j, value)| (i + n, j + n, value)));
                n += matrix(body).size();
            }
            Symmetric::from_entries(n, entries)
        };
        Self { mass: joined(|b| &b.mass), damping: joined(|b| &b.damping), stiffness: joined(|b| &b.stiffness) }
    }
}

/// One place on a structure that moves in two planes: the displacement there is (g_y · q, g_z · q).
///
/// ```
/// use signorini::PlaneRows;
///
/// // The second of three masses in each plane; a wall, load or probe there, 30° from +y to +z.
/// let place = PlaneRows::doubled(&signorini::Row::dof(1), 3);
/// let seen = place.along(30.0).dot(&[0.0, 2.0, 0.0, 0.0, 1.0, 0.0]);
/// assert!((seen - (2.0 * 0.75_f64.sqrt() + 0.5)).abs() < 1e-15);
/// assert_eq!(place.along(90.0), signorini::Row::dof(4));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaneRows {
    /// The row of the displacement along +y.
    pub y: Row,
    /// The row of the displacement along +z.
    pub z: Row,
}

impl PlaneRows {
    /// The place that has the row `row` in each plane of [`Structure::in_two_planes`], where a
    /// plane has `n` degrees of freedom.
    #[must_use]
    pub fn doubled(row: &Row, n: usize) -> Self {
        Self { y: row.clone(), z: row.shifted(n) }
    }

    /// (g_y · x, g_z · x) for `x` of one value per degree of freedom.
    #[must_use]
    pub fn dot(&self, x: &[f64]) -> [f64; 2] {
        [self.y.dot(x), self.z.dot(x)]
    }

    /// The row of the displacement in a direction, in degrees from +y towards +z: cos α g_y +
    /// sin α g_z.
    #[must_use]
    pub fn along(&self, degrees: f64) -> Row {
        self.towards(heading(degrees))
    }

    /// The displacement relative to that at `other`.
    #[cfg(feature = "case")]
    pub(crate) fn relative_to(&self, other: &Self) -> Self {
        Self { y: self.y.relative_to(&other.y), z: self.z.relative_to(&other.z) }
    }

    /// The same place on a structure in other coordinates, where `row` turns each row into that of
    /// the same place there.
    pub(crate) fn carried(&self, mut row: impl FnMut(&Row) -> Row) -> Self {
        Self { y: row(&self.y), z: row(&self.z) }
    }

    /// The row of the displacement along the unit vector (y, z).
    pub(crate) fn towards(&self, [y, z]: [f64; 2]) -> Row {
        Row::combination([(y, &self.y), (z, &self.z)])
    }
}

#[cfg(test)]
mod tests {
    use super::heading;

    #[test]
    fn directions_along_the_axes_are_exact_and_turn_from_y_to_z() {
        for (degrees, [y, z]) in [(0.0, [1.0, 0.0]), (90.0, [0.0, 1.0]), (-90.0, [0.0, -1.0]), (540.0, [-1.0, 0.0])] {
            assert_eq!(heading(degrees), [y, z], "{degrees}");
        }
        // 30°, whose cosine and sine are √3/2 and 1/2, here and a whole turn on.
        for degrees in [30.0, 390.0, -330.0] {
            let [y, z] = heading(degrees);
            assert!((y - 0.75_f64.sqrt()).abs() < 2e-16 && (z - 0.5).abs() < 2e-16, "{degrees}: {y} {z}");
        }
    }
}
