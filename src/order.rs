//! Sorts by a number: numbers alone are sorted, by one function, so that the sort of the standard
//! library is not compiled anew for each type and each key.

/// Sorts `list` by rising `number`, in the order of [`f64::total_cmp`]; elements of the same number
/// stay in their order.
pub(crate) fn sort_by_number<T>(list: &mut [T], number: impl Fn(&T) -> f64) {
    let numbers: Vec<f64> = list.iter().map(number).collect();
    let mut places = places(&numbers);
    // Each exchange brings one element to its place.
    for at in 0..list.len() {
        while let Some(&to) = places.get(at).filter(|to| **to != at) {
            list.swap(at, to);
            places.swap(at, to);
        }
    }
}

/// For each of `numbers` its place in the sorted list.
fn places(numbers: &[f64]) -> Vec<usize> {
    let number = |index: usize| numbers.get(index).copied().unwrap_or(f64::NAN);
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|&a, &b| number(a).total_cmp(&number(b)));
    let mut places = vec![0; order.len()];
    for (place, index) in order.into_iter().enumerate() {
        places.get_mut(index).into_iter().for_each(|own| *own = place);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::sort_by_number;
    use crate::hash::{mix, unit};

    #[test]
    fn lists_are_sorted_as_the_standard_library_does() {
        for seed in 0..200 {
            let length = seed % 23;
            // Numbers that repeat, so that the order of equal ones shows, and both zeros.
            let number = |k: u64| (unit(mix(seed, k, 0)) * 7.0).floor() - 3.0;
            let mut list: Vec<(u64, f64)> = (0..length).map(|k| (k, number(k))).collect();
            list.iter_mut().filter(|(k, x)| k % 2 == 0 && *x == 0.0).for_each(|(_, x)| *x = -0.0);
            let mut expected = list.clone();
            expected.sort_by(|a, b| a.1.total_cmp(&b.1));
            sort_by_number(&mut list, |one| one.1);
            assert_eq!(list, expected);
            // Falling, by the number with the other sign.
            expected.sort_by(|a, b| b.1.total_cmp(&a.1));
            sort_by_number(&mut list, |one| -one.1);
            assert_eq!(list, expected);
        }
    }
}
