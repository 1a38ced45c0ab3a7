//! Columns of numbers as the page takes them: little-endian bytes in base64, which a browser turns
//! into a typed array at once; a text of digits would be several times as long.

use serde_json::{Value, json};
use std::collections::HashMap;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// `bytes` in base64 with padding (RFC 4648, section 4).
pub(super) fn base64(bytes: &[u8]) -> String {
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let index = bits >> (18 - 6 * digit) & 63;
            out.push(if digit > chunk.len() as u32 { '=' } else { char::from(DIGITS[index as usize]) });
        }
    }
    out
}

/// Numbers with all their digits; NaN stays NaN.
pub(super) fn f64(values: &[f64]) -> Value {
    json!({ "f64": base64(&values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()) })
}

/// Numbers to seven digits: enough to draw, not to subtract.
pub(super) fn f32(values: impl Iterator<Item = f64>) -> Value {
    json!({ "f32": base64(&values.flat_map(|x| (x as f32).to_le_bytes()).collect::<Vec<u8>>()) })
}

/// Indices.
pub(super) fn u32(values: &[usize]) -> Value {
    let bytes: Vec<u8> = values.iter().flat_map(|&i| u32::try_from(i).unwrap_or(u32::MAX).to_le_bytes()).collect();
    json!({ "u32": base64(&bytes) })
}

/// Numbers as shares of the largest |x|, in steps of 1/32767: for a drawing of which that is less
/// than a pixel. A number that is not finite becomes 0.
pub(super) fn i16(values: &[f64]) -> Value {
    let largest = values.iter().map(|x| x.abs()).filter(|x| x.is_finite()).fold(0.0, f64::max);
    let unit = if largest > 0.0 { largest / f64::from(i16::MAX) } else { 1.0 };
    let bytes: Vec<u8> = values.iter().flat_map(|x| ((x / unit).round() as i16).to_le_bytes()).collect();
    json!({ "i16": base64(&bytes), "unit": unit })
}

/// Words: each distinct one once, and for every row its index.
pub(super) fn words<'a>(cells: impl Iterator<Item = &'a str>) -> Value {
    let mut known: HashMap<&str, usize> = HashMap::new();
    let mut list = Vec::new();
    let mut at = Vec::new();
    for cell in cells {
        let next = list.len();
        let index = *known.entry(cell).or_insert(next);
        if index == next {
            list.push(cell);
        }
        at.push(index);
    }
    json!({ "words": list, "at": u32(&at) })
}

/// The rows to draw, in order, where there are more than `most`: of each stretch of equally many
/// rows those in which one of `columns` is least or largest; also the first and the last row. So no
/// peak is lost.
pub(super) fn extremes(columns: &[&[f64]], count: usize, most: usize) -> Option<Vec<usize>> {
    if count <= most {
        return None;
    }
    let stretch = (2 * columns.len().max(1) * count).div_ceil(most).max(1);
    let mut kept = vec![0, count - 1];
    for from in (0..count).step_by(stretch) {
        let to = (from + stretch).min(count);
        for column in columns {
            let values = || column.get(from..to).into_iter().flatten().enumerate();
            let (mut least, mut largest) = ((from, f64::INFINITY), (from, f64::NEG_INFINITY));
            for (i, &x) in values() {
                if x < least.1 {
                    least = (from + i, x);
                }
                if x > largest.1 {
                    largest = (from + i, x);
                }
            }
            kept.extend([least.0, largest.0]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    Some(kept)
}

#[cfg(test)]
mod tests {
    use super::{base64, extremes, i16};

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_that_of_the_rfc() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in vectors {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn a_single_peak_among_many_rows_is_kept() {
        let mut column = vec![0.0; 100_000];
        column[77_777] = 1.0;
        column[12_345] = -1.0;
        let kept = extremes(&[&column], column.len(), 1000).unwrap();
        assert!(kept.contains(&77_777) && kept.contains(&12_345) && kept.len() <= 1002);
        assert_eq!((kept[0], kept.last()), (0, Some(&99_999)));
        assert!(extremes(&[&column], 100_000, 100_000).is_none());
    }

    #[test]
    fn what_is_not_finite_is_drawn_at_0() {
        assert_eq!(i16(&[f64::NAN, f64::INFINITY, 2.0])["unit"], 2.0 / 32767.0);
    }
}
