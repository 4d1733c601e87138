//! The results that a file carries.

use super::motions::Effort;
use super::parts::{Frame, Marker, Parts};
use crate::space::{axis, bryant, cross, minus, plus, times, turned, Plane, Vector};
use crate::unread::UnreadList;
use std::collections::HashMap;

/// Columns by name: `t`, and quantities of kempe.
pub(crate) type Columns = Vec<(String, Vec<f64>)>;

type Rows<'a> = HashMap<&'a str, Vec<f64>>;

/// The series of a file by the path of their part, joint or motion.
#[derive(Debug, Default)]
pub(super) struct Series<'a> {
    t: Vec<f64>,
    of: HashMap<&'a str, Rows<'a>>,
}

/// Reads the lines after `TimeSeries`. The first column of each row is the input and not a result.
pub(super) fn read<'a>(lines: &[(usize, &'a str)], unread: &mut UnreadList) -> Series<'a> {
    let mut series = Series::default();
    let mut current = None;
    for (line, text) in lines {
        let mut words = text.split('\t').map(str::trim).filter(|word| !word.is_empty());
        let Some(key) = words.next() else { continue };
        if let Some((class, path)) = text.split_once("Series") {
            if class.chars().all(|c| c.is_ascii_alphabetic()) {
                current = Some(path.trim());
                continue;
            }
        }
        if key == "Number" {
            continue;
        }
        let numbers: Option<Vec<f64>> =
            words.skip(1).map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        match (numbers, current) {
            (None, _) => unread.left(*line, format!("results {key}: not a row of numbers")),
            (Some(numbers), _) if key == "Time" => series.t = numbers,
            (Some(numbers), Some(path)) if numbers.len() == series.t.len() => {
                series.of.entry(path).or_default().insert(key, numbers);
            }
            (Some(numbers), _) => {
                let (found, wanted) = (numbers.len(), series.t.len());
                unread.left(*line, format!("results {key}: {found} numbers for {wanted} times"));
            }
        }
    }
    series
}

/// A joint of the case: its name, and the path and markers in the file.
#[derive(Debug)]
pub(super) struct Reacting {
    pub(super) name: String,
    pub(super) path: String,
    pub(super) i: Marker,
    pub(super) j: Marker,
    /// Whether the reaction acts at the markers, so that its torque can be compared.
    pub(super) torque: bool,
}

impl Series<'_> {
    /// The vector of three rows at a time.
    fn vector(&self, path: &str, keys: [&str; 3], k: usize) -> Option<Vector> {
        let rows = self.of.get(path)?;
        let number = |key: &str| rows.get(key).map(|row| row[k]);
        Some([number(keys[0])?, number(keys[1])?, number(keys[2])?])
    }

    fn column(&self, of: impl Fn(usize) -> Option<f64>) -> Option<Vec<f64>> {
        (0..self.t.len()).map(of).collect()
    }

    /// The frame of a part at a time.
    fn frame(&self, parts: &Parts, part: usize, k: usize) -> Option<Frame> {
        if part == 0 {
            return Some(parts.all[0].frame);
        }
        let path = &parts.all[part].path;
        let place = self.vector(path, ["X", "Y", "Z"], k)?;
        Some(Frame {
            place,
            turn: bryant(self.vector(path, ["Bryantx", "Bryanty", "Bryantz"], k)?),
        })
    }

    /// The results as columns with the names of the case.
    pub(super) fn columns(
        &self,
        plane: &Plane,
        parts: &Parts,
        joints: &[Reacting],
        efforts: &[Effort],
        t_start: f64,
    ) -> Columns {
        if self.t.is_empty() || self.of.is_empty() {
            return Vec::new();
        }
        let mut columns = vec![("t".to_string(), self.t.iter().map(|t| t - t_start).collect())];
        for part in 1..parts.all.len() {
            self.motion(&mut columns, plane, parts, part);
        }
        for joint in joints {
            self.reaction(&mut columns, plane, parts, joint);
        }
        for effort in efforts {
            let column = self.column(|k| {
                let marker = self.frame(parts, effort.i.part, k)?.of(&effort.i.frame);
                let keys = if effort.rotates {
                    ["TXonI", "TYonI", "TZonI"]
                } else {
                    ["FXonI", "FYonI", "FZonI"]
                };
                let on_i = self.vector(&effort.path, keys, k)?;
                let along = if effort.rotates { plane.normal } else { axis(&marker.turn, 2) };
                Some(-crate::space::dot(on_i, along))
            });
            columns.extend(column.map(|column| (format!("{}.effort", effort.name), column)));
        }
        columns
    }

    fn motion(&self, columns: &mut Columns, plane: &Plane, parts: &Parts, part: usize) {
        let body = &parts.all[part];
        let flat = [
            (["X", "Y", "Z"], ["x", "y"]),
            (["VX", "VY", "VZ"], ["vx", "vy"]),
            (["AX", "AY", "AZ"], ["ax", "ay"]),
        ];
        for (keys, names) in flat {
            for (k, name) in names.into_iter().enumerate() {
                let column =
                    self.column(|at| Some(plane.flat(self.vector(&body.path, keys, at)?)[k]));
                columns.extend(column.map(|column| (format!("{}.{name}", body.name), column)));
            }
        }
        let turns =
            [(["OmegaX", "OmegaY", "OmegaZ"], "omega"), (["AlphaX", "AlphaY", "AlphaZ"], "alpha")];
        for (keys, name) in turns {
            let column =
                self.column(|at| Some(plane.across_of(self.vector(&body.path, keys, at)?)));
            columns.extend(column.map(|column| (format!("{}.{name}", body.name), column)));
        }
        let mut last = body.angle;
        let mut angles = Vec::with_capacity(self.t.len());
        for k in 0..self.t.len() {
            let Some(frame) = self.frame(parts, part, k) else { return };
            let [x, y] = plane.flat(turned(&frame.turn, body.along));
            let turn = std::f64::consts::TAU;
            let angle = y.atan2(x);
            last = angle + turn * ((last - angle) / turn).round();
            angles.push(last);
        }
        columns.push((format!("{}.angle", body.name), angles));
    }

    /// Force and torque on both bodies; the file has those on part I, about marker I.
    fn reaction(&self, columns: &mut Columns, plane: &Plane, parts: &Parts, joint: &Reacting) {
        for (marker, sign) in [(&joint.i, 1.0), (&joint.j, -1.0)] {
            if marker.part == 0 {
                continue;
            }
            let body = &parts.all[marker.part].name;
            let force =
                |k| Some(times(sign, self.vector(&joint.path, ["FXonI", "FYonI", "FZonI"], k)?));
            for (at, name) in ["fx", "fy"].into_iter().enumerate() {
                let column = self.column(|k| Some(plane.flat(force(k)?)[at]));
                columns.extend(
                    column.map(|column| (format!("{}.{name}_on_{body}", joint.name), column)),
                );
            }
            let torque = self.column(|k| {
                let about_i =
                    times(sign, self.vector(&joint.path, ["TXonI", "TYonI", "TZonI"], k)?);
                let from = self.frame(parts, joint.i.part, k)?.of(&joint.i.frame).place;
                let to = self.frame(parts, marker.part, k)?.of(&marker.frame).place;
                Some(plane.across_of(plus(about_i, cross(minus(from, to), force(k)?))))
            });
            let torque = torque.filter(|_| joint.torque);
            columns
                .extend(torque.map(|column| (format!("{}.torque_on_{body}", joint.name), column)));
        }
    }
}
