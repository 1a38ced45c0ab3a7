//! Where a letter fits: the largest square within each connected region of a grid of classes.

/// Squares of cells, at most one per region: (class, column, row, side), with the column and row of
/// the middle.
///
/// `classes` is row by row, `columns` cells each. Squares are found by side[i][j] = 1 + min over
/// the three cells before.
pub(super) fn letter_places(classes: &[usize], columns: usize) -> Vec<(usize, f64, f64, usize)> {
    let at = |column: usize, row: usize| classes.get(row * columns + column).copied();
    let mut sides = vec![0_usize; classes.len()];
    let mut region: Vec<usize> = (0..classes.len()).collect();
    for (i, class) in classes.iter().enumerate() {
        let (column, row) = (i % columns, i / columns);
        let before = |dc: usize, dr: usize| -> Option<usize> {
            let (column, row) = (column.checked_sub(dc)?, row.checked_sub(dr)?);
            (at(column, row) == Some(*class)).then_some(row * columns + column)
        };
        for neighbour in [before(1, 0), before(0, 1)].into_iter().flatten() {
            let (a, b) = (root(&mut region, i), root(&mut region, neighbour));
            if let Some(parent) = region.get_mut(a.max(b)) {
                *parent = a.min(b);
            }
        }
        let side = |cell: Option<usize>| cell.and_then(|cell| sides.get(cell)).copied().unwrap_or(0);
        let least = side(before(1, 0)).min(side(before(0, 1))).min(side(before(1, 1)));
        if let Some(side) = sides.get_mut(i) {
            *side = least + 1;
        }
    }
    // The largest square of every region; of equals, the first.
    let mut best: std::collections::BTreeMap<usize, (usize, usize)> = std::collections::BTreeMap::new();
    for (i, side) in sides.iter().enumerate() {
        let entry = best.entry(root(&mut region, i)).or_insert((*side, i));
        if *side > entry.0 {
            *entry = (*side, i);
        }
    }
    let place = |(side, i): (usize, usize)| {
        let back = side as f64 / 2.0;
        let class = classes.get(i).copied().unwrap_or(0);
        (class, (i % columns) as f64 + 1.0 - back, (i / columns) as f64 + 1.0 - back, side)
    };
    best.into_values().map(place).collect()
}

/// The smallest cell index of a region, with path compression (union–find).
fn root(region: &mut [usize], mut cell: usize) -> usize {
    while let Some(parent) = region.get(cell).copied().filter(|parent| *parent != cell) {
        let grandparent = region.get(parent).copied().unwrap_or(parent);
        if let Some(entry) = region.get_mut(cell) {
            *entry = grandparent;
        }
        cell = grandparent;
    }
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_region_gets_one_letter_in_its_largest_square() {
        #[rustfmt::skip]
        let classes = [
            0, 0, 0, 1,
            0, 0, 0, 1,
            0, 0, 0, 0,
            1, 0, 1, 1,
        ];
        let places = letter_places(&classes, 4);
        assert_eq!(places, vec![(0, 1.5, 1.5, 3), (1, 3.5, 0.5, 1), (1, 0.5, 3.5, 1), (1, 2.5, 3.5, 1)]);
    }
}
