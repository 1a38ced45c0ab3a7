//! Tables for the terminal: as wide as it allows, with no number broken over two lines.

use comfy_table::{CellAlignment, ContentArrangement, Table as Grid, presets};
use serde_json::{Value, json};

/// Space between two columns.
const BETWEEN: usize = 2;

/// Text shorter than this is not broken where space is short.
const TEXT: usize = 16;

/// Headings, and rows of cells; the first column names what a row is about.
#[derive(Debug, Clone, Default)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    widest: Option<usize>,
    /// The first of the columns that stand together.
    together: Option<usize>,
    /// The columns that stand beside the one before them.
    attached: Vec<usize>,
}

/// A table laid out for a width.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fitted {
    /// Its lines.
    pub text: String,
    /// Headings of the columns that are too wide even by themselves.
    pub left_out: Vec<String>,
}

impl Table {
    /// A table under `header`. Where it is too wide, columns that do not fit stand in a second
    /// block below the first, again after the column of names.
    #[must_use]
    pub fn new(header: &[impl AsRef<str>], rows: Vec<Vec<String>>) -> Self {
        Self {
            header: header.iter().map(|text| text.as_ref().to_owned()).collect(),
            rows,
            widest: None,
            together: None,
            attached: Vec::new(),
        }
    }

    /// The same table, never wider than `width` characters where its text can be broken.
    #[must_use]
    pub fn within(mut self, width: usize) -> Self {
        self.widest = Some(width);
        self
    }

    /// The same table; where its columns from number `first` on do not fit with those before them,
    /// they begin a block.
    #[must_use]
    pub fn together_from(mut self, first: usize) -> Self {
        self.together = Some(first);
        self
    }

    /// The same table, whose `columns` each stand in the block of the column before it.
    #[must_use]
    pub fn attached(mut self, columns: impl IntoIterator<Item = usize>) -> Self {
        self.attached = columns.into_iter().collect();
        self
    }

    /// Its header and its rows, for a page.
    #[must_use]
    pub fn document(&self) -> Value {
        json!({ "header": self.header, "rows": self.rows })
    }

    /// The table in at most `width` characters (as wide as needed where `width` is `None`). Where
    /// that is too narrow, text is broken between words; numbers never are. A column that does not
    /// fit beside the names is left out; the first is always shown, even where it is wider.
    #[must_use]
    pub fn fit(&self, width: Option<usize>) -> Fitted {
        let room = [width, self.widest].into_iter().flatten().min().unwrap_or(usize::MAX);
        let whole: Vec<usize> = (0..self.header.len()).map(|column| self.widest(column, false)).collect();
        let fits = whole.iter().map(|w| w + BETWEEN).sum::<usize>() <= room.saturating_add(BETWEEN);
        let narrow = |(column, &whole): (usize, &usize)| self.widest(column, true).max(whole.min(TEXT));
        let widths = if fits { whole } else { whole.iter().enumerate().map(narrow).collect() };
        let first = widths.first().copied().unwrap_or(0);
        let beside = |column: usize| widths.get(column).map_or(0, |wide| wide + BETWEEN);
        let (left_out, mut rest): (Vec<usize>, Vec<usize>) =
            (1..self.header.len()).partition(|&column| column > 1 && first + beside(column) > room);
        let mut text = Vec::new();
        while text.is_empty() || !rest.is_empty() {
            let mut used = first;
            let fits = |&&column: &&usize| {
                used += beside(column);
                used <= room
            };
            let count = rest.iter().take_while(fits).count().max(1).min(rest.len());
            let begins = rest.iter().position(|column| Some(*column) == self.together).filter(|at| *at > 0);
            let count = begins.filter(|at| *at < count && count < rest.len()).unwrap_or(count);
            let is_torn = |count: &usize| rest.get(*count).is_some_and(|column| self.attached.contains(column));
            let count = (1..=count).rev().find(|count| !is_torn(count)).unwrap_or(count);
            let shown: Vec<usize> = std::iter::once(0).chain(rest.drain(..count)).collect();
            text.push(self.block(&shown, &widths));
        }
        let left_out = left_out.into_iter().filter_map(|column| self.header.get(column).cloned()).collect();
        Fitted { text: text.join("\n\n"), left_out }
    }

    /// Width of a column: of its heading, broken wherever it may be, and of its cells; text cells
    /// are broken too where `broken` is true.
    fn widest(&self, column: usize, broken: bool) -> usize {
        let parts = |text: &str| pieces(text).map(wide).max().unwrap_or(0);
        let cell = |text: &String| if broken && !is_number(text) { parts(text) } else { wide(text) };
        let cells = self.rows.iter().filter_map(|row| row.get(column)).map(cell).max().unwrap_or(0);
        cells.max(self.header.get(column).map_or(0, |text| parts(text)))
    }

    fn block(&self, columns: &[usize], widths: &[usize]) -> String {
        let mut grid = Grid::new();
        grid.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
        let fitted = |column: usize, text: Option<&String>| {
            let width = widths.get(column).copied().unwrap_or(usize::MAX);
            text.map_or_else(String::new, |text| if wide(text) > width { broken(text, width) } else { text.clone() })
        };
        grid.set_header(columns.iter().map(|&column| fitted(column, self.header.get(column))));
        for row in &self.rows {
            grid.add_row(columns.iter().map(|&column| fitted(column, row.get(column))));
        }
        for (place, &column) in columns.iter().enumerate() {
            if let Some(shown) = grid.column_mut(place) {
                shown.set_padding((0, if place + 1 < columns.len() { BETWEEN as u16 } else { 0 }));
                if column > 0 && self.is_numeric(column) {
                    shown.set_cell_alignment(CellAlignment::Right);
                }
            }
        }
        grid.trim_fmt()
    }

    /// True for a column of numbers, which is aligned at the right.
    fn is_numeric(&self, column: usize) -> bool {
        let cells = self.rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.is_empty());
        let numbers = cells.clone().filter(|cell| is_number(cell)).count();
        2 * numbers > cells.count()
    }
}

/// True for a number, and for the dash that stands for a missing one.
fn is_number(text: &str) -> bool {
    text == "-" || text.parse::<f64>().is_ok()
}

fn wide(text: &str) -> usize {
    text.chars().count()
}

/// The parts of a heading that are not broken: `largest force (N)` is `largest`, `force`, `(N)`,
/// and `penalty:epsilon=1e-9,integrator=trapezoidal` breaks after `:` and `,`. A unit in brackets
/// stays whole.
fn pieces(text: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_usize;
    let breaks = move |c: char| {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && matches!(c, ' ' | ':' | ',')
    };
    text.split_inclusive(breaks).map(str::trim_end)
}

/// `text` in lines of at most `width`, broken between its pieces.
fn broken(text: &str, width: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces(text) {
        match lines.last_mut() {
            Some(line) => {
                let gap = if line.ends_with([':', ',']) { "" } else { " " };
                if wide(line) + gap.len() + wide(piece) <= width {
                    line.push_str(gap);
                    line.push_str(piece);
                } else {
                    lines.push(piece.to_owned());
                }
            }
            None => lines.push(piece.to_owned()),
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let row = |name: &str| vec![name.to_owned(), "12".to_owned(), "+0.123456".to_owned(), "1.5e-12".to_owned()];
        Table::new(&["wall", "contacts", "impulse (N s)", "complementarity residual"], vec![row("upper"), row("lower")])
    }

    #[test]
    fn what_does_not_fit_stands_in_a_second_block() {
        let wide_enough = table().fit(None);
        assert_eq!((wide_enough.text.matches("upper").count(), wide_enough.left_out), (1, Vec::<String>::new()));
        let narrow = table().fit(Some(30));
        assert!(narrow.left_out.is_empty());
        assert_eq!((narrow.text.matches("upper").count(), narrow.text.matches("1.5e-12").count()), (2, 2));
        assert_eq!(narrow.text.lines().filter(|line| line.ends_with("+0.123456")).count(), 2);
        assert!(narrow.text.lines().all(|line| line.chars().count() <= 30));
        // What belongs together begins a block, unless all fits in one.
        let first = |width: usize| table().together_from(2).fit(Some(width)).text.lines().next().unwrap().to_owned();
        assert!(first(30).ends_with("contacts") && first(80).contains("impulse"), "{} {}", first(30), first(80));
        // What is attached stands in the block of the column before it.
        let attached = table().attached([3]).fit(Some(40)).text;
        let blocks: Vec<&str> = attached.split("\n\n").collect();
        assert!(blocks.len() == 2 && !blocks[0].contains("0.123456") && blocks[1].contains("1.5e-12"), "{attached}");
    }

    #[test]
    fn a_column_that_is_too_wide_by_itself_is_left_out_and_named() {
        let narrow = table().fit(Some(17));
        assert_eq!(narrow.left_out, ["complementarity residual"]);
        assert!(narrow.text.lines().all(|line| line.chars().count() <= 17), "{}", narrow.text);
        assert_eq!(narrow.text.matches("+0.123456").count(), 2);
        // The first is shown in any case.
        let none = table().fit(Some(5));
        assert_eq!(none.left_out, ["impulse (N s)", "complementarity residual"]);
        assert!(none.text.contains("12"), "{}", none.text);
    }

    #[test]
    fn headings_break_between_their_words_only() {
        assert_eq!(
            broken("penalty:epsilon=1e-9,integrator=trapezoidal", 23),
            "penalty:epsilon=1e-9,\nintegrator=trapezoidal"
        );
        assert_eq!(broken("impulse (N s)", 8), "impulse\n(N s)");
        assert_eq!(broken("impulse (N s)", 13), "impulse (N s)");
    }
}
