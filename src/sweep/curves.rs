//! Curves of measures.

use super::columns::{Source, SweepAxis, half_width_of, place_of, place_suffix, short};
use super::picture::{Drawn, MOST_PANELS, Picture};
use super::seeds::in_words;
use super::table::{TABLE, Table, label, quantity};
use crate::error::Result;
use crate::order::sort_by_number;
use crate::output::colours::{DOWN, Places, UP};
use crate::output::extent;
use crate::output::figure::{Curve, Figure, Panel, Scale, Scatter};

/// Maximum number of curves in one panel.
const MOST_CURVES: usize = 8;

/// Maximum number of groups of points of a random design.
const MOST_CLOUDS: usize = 2;

/// One curve: what it is of, and its points.
struct MeasureCurve {
    label: String,
    direction: String,
    /// The wall or probe that its column names.
    place: String,
    /// Pairs (x, y), each with the half width of its interval, NaN where there is none.
    points: Vec<((f64, f64), f64)>,
}

impl Picture {
    pub(super) fn line(&self, source: &Source<'_>) -> Result<Option<Drawn>> {
        let x = Self::axis(self.x.as_ref(), source)?;
        let mut groups = self.measures(self.y.as_ref(), source)?;
        let panels = if source.random { 1 } else { MOST_PANELS };
        let beyond = groups.split_off(panels.min(groups.len()));
        let mut left_out: Vec<String> = beyond.into_iter().map(|(measure, _)| measure).collect();
        if !x.is_numeric(source) || groups.is_empty() {
            return Ok(None);
        }
        let table = Table::open(&source.folder.join(TABLE))?;
        let own = table.column(&x.column)?;
        let other = |axis: &&SweepAxis| axis.column != x.column;
        let named = |axis: &SweepAxis| Ok((table.column(&axis.column)?, quantity(&axis.column).to_lowercase()));
        let others: Vec<(usize, String)> = source.axes.iter().filter(other).map(named).collect::<Result<_>>()?;
        let direction = table.column("direction").ok();
        let wanted = |(measure, columns): &(String, Vec<String>)| -> Result<Vec<_>> {
            let half_width = |column: &str| table.column(&half_width_of(column, measure)).ok();
            columns.iter().map(|column| Ok((table.column(column)?, half_width(column)))).collect()
        };
        let wanted: Vec<Vec<(usize, Option<usize>)>> = groups.iter().map(wanted).collect::<Result<_>>()?;
        let most = if source.random { MOST_CLOUDS } else { MOST_CURVES };
        // By panel, then by column and group of rows: points.
        let mut curves: Vec<Vec<MeasureCurve>> = groups.iter().map(|_| Vec::new()).collect();
        table.each(|row| {
            let Some(at) = row.number(own) else { return };
            let direction = direction.map(|index| row.text(index).to_owned()).unwrap_or_default();
            let mut words: Vec<String> = (!direction.is_empty()).then(|| direction.clone()).into_iter().collect();
            if !source.random {
                words.extend(others.iter().map(|(index, name)| format!("{name} {}", short(row.text(*index)))));
            }
            for ((curves, columns), (measure, names)) in curves.iter_mut().zip(&wanted).zip(&groups) {
                for (&(index, half_width), name) in columns.iter().zip(names) {
                    let place = place_of(name, measure);
                    let label =
                        [(!place.is_empty()).then(|| place.clone()), (!words.is_empty()).then(|| words.join(", "))];
                    let label = label.into_iter().flatten().collect::<Vec<_>>().join(": ");
                    let number = |index: usize| row.number(index).unwrap_or(f64::NAN);
                    let point = ((at, number(index)), half_width.map_or(f64::NAN, number));
                    match curves.iter().position(|known| known.label == label) {
                        Some(known) => curves[known].points.push(point),
                        None if curves.len() < most => {
                            let (direction, place) = (direction.clone(), source.place(name, measure));
                            curves.push(MeasureCurve { label, direction, place, points: vec![point] });
                        }
                        None => {
                            let name = format!("{measure} {label}");
                            if !left_out.contains(&name) {
                                left_out.push(name);
                            }
                        }
                    }
                }
            }
        })?;
        let title = titled(source, left_out.len());
        if source.random {
            return Ok(cloud(&title, x, &groups, &curves).map(|svg| Drawn { svg, left_out }));
        }
        Ok(Some(Drawn { svg: figure(title, x, &groups, curves, source).to_svg(), left_out }))
    }
}

/// The title of a picture that leaves out so many curves; it says what the bands are.
fn titled(source: &Source<'_>, left_out: usize) -> String {
    let seeds = source.seeds.map(|count| format!("means of {}, 95 % intervals", in_words(count)));
    let left_out = (left_out > 0).then(|| format!("{left_out} more left out"));
    let told: Vec<String> = [seeds, left_out].into_iter().flatten().collect();
    if told.is_empty() { source.title.to_owned() } else { format!("{}: {}", source.title, told.join("; ")) }
}

/// A panel of curves for each measure, over `x`.
fn figure(
    title: String,
    x: &SweepAxis,
    groups: &[(String, Vec<String>)],
    curves: Vec<Vec<MeasureCurve>>,
    source: &Source<'_>,
) -> Figure {
    let mut figure = Figure::new(title, label(&x.column));
    if x.scale == Scale::Log {
        figure = figure.log();
    }
    for (curves, (measure, columns)) in curves.into_iter().zip(groups) {
        let column = columns.first().map(|column| label(&column.replace(&place_suffix(column, measure), "")));
        let mut panel = Panel::new(column.unwrap_or_else(|| measure.clone()));
        for (MeasureCurve { label, mut points, .. }, colour) in coloured(curves, source) {
            sort_by_number(&mut points, |a| a.0.0);
            let few = points.len() <= 60;
            let (points, half_widths): (Vec<_>, Vec<f64>) = points.into_iter().unzip();
            let curve = Curve::new(label, points).banded(half_widths);
            let curve = match colour {
                Some((look, colour)) => curve.look(look).colour(colour),
                None => curve,
            };
            panel = panel.curve(if few { curve.marked() } else { curve });
        }
        figure = figure.panel(panel);
    }
    figure
}

/// The curves of a panel, each with its look and the look of its colour: of rows up and down those
/// of the direction, else that of the wall or support; `None` of a curve of neither.
fn coloured(curves: Vec<MeasureCurve>, source: &Source<'_>) -> Vec<(MeasureCurve, Option<(usize, usize)>)> {
    let both = ["up", "down"].iter().all(|way| curves.iter().any(|curve| curve.direction == *way));
    let [walls, supports] = [&source.walls, &source.supports].map(|names| names.iter().map(String::as_str));
    let places = Places::new(walls, supports);
    let mut seen: Vec<usize> = Vec::new();
    let mut colour = |curve: &MeasureCurve| {
        let colour = if both {
            if curve.direction == "down" { DOWN } else { UP }
        } else {
            let mut names = source.walls.iter().chain(&source.supports);
            names.find(|name| **name == curve.place).map(|name| places.colour(name))?
        };
        // Curves of one colour differ in dashes and markers.
        let look = seen.iter().filter(|other| **other == colour).count();
        seen.push(colour);
        Some((look, colour))
    };
    let looks: Vec<_> = curves.iter().map(&mut colour).collect();
    curves.into_iter().zip(looks).collect()
}

/// A measure over one coordinate of the points of a random design.
fn cloud(title: &str, x: &SweepAxis, groups: &[(String, Vec<String>)], curves: &[Vec<MeasureCurve>]) -> Option<String> {
    let (curves, (measure, columns)) = (curves.first()?, groups.first()?);
    let labels: Vec<&str> = curves.iter().map(|curve| curve.label.as_str()).collect();
    let all = || curves.iter().flat_map(|curve| &curve.points).map(|(point, _)| point);
    let points = || all().filter(|p| p.0.is_finite() && p.1.is_finite());
    let range = |pick: fn(&(f64, f64)) -> f64| extent(points().map(pick));
    let column = columns.first()?;
    let y_label = label(&column.replace(&place_suffix(column, measure), ""));
    points().next()?;
    let x_label = label(&x.column);
    let mut scatter =
        Scatter::new(title, (&x_label, x.scale, range(|p| p.0)), (&y_label, Scale::Linear, range(|p| p.1)), &labels);
    for (group, curve) in curves.iter().enumerate() {
        curve.points.iter().for_each(|((x, y), _)| scatter.add(group, *x, *y));
    }
    Some(scatter.to_svg())
}
