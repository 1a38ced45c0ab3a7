//! Numbers as a page shows them, read back.

/// The number at the beginning of `shown`, and the half width of its interval where it has one:
/// `0.123`, `0.12 ± 0.03 mm` or `(1.2 ± 0.3)·10⁻⁵`.
pub fn number_with_half_width(shown: &str) -> (f64, Option<f64>) {
    let text = shown.trim_start_matches('(').replace('−', "-");
    let (first, rest) = leading_number(&text);
    let first = first.unwrap_or_else(|| panic!("{shown:?}"));
    let (half, rest) = rest.strip_prefix(" ± ").map_or((None, rest), leading_number);
    let raised = rest.trim_start_matches(')').strip_prefix("·10").unwrap_or_default();
    let digit = |c: char| match c {
        '⁻' => Some('-'),
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip('0'..='9').find_map(|(up, digit)| (up == c).then_some(digit)),
    };
    let power: String = raised.chars().map_while(digit).collect();
    let scale = 10_f64.powi(power.parse().unwrap_or(0));
    (first * scale, half.map(|half| half * scale))
}

/// The number at the beginning of `text`, and what follows it.
fn leading_number(text: &str) -> (Option<f64>, &str) {
    let end = text.find(|c: char| !(c.is_ascii_digit() || "-.".contains(c))).unwrap_or(text.len());
    let number = text[..end].trim_end_matches('.');
    (number.parse().ok(), &text[number.len()..])
}

/// True where `shown` is `x` to its last digit: to four of its own, or to the second of the half
/// width beside it, whose tenth or more is a unit of the last place.
pub fn same(shown: &str, x: f64) -> bool {
    let (value, half) = number_with_half_width(shown);
    (value - x).abs() <= half.map_or(6e-4 * x.abs(), |half| 0.06 * half)
}
