//! The variables of a search.

use super::{entry, number, refused};
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::model::Value as Written;

/// A variable between its bounds.
pub struct Bound {
    /// The parameter.
    pub name: String,
    /// Its least and largest value.
    pub ends: [f64; 2],
    log: bool,
    /// Its value in the text.
    pub before: f64,
}

impl Bound {
    /// The value at a point of the unit interval; both ends are exact.
    pub fn at(&self, share: f64) -> f64 {
        let [least, largest] = self.ends;
        match share {
            _ if share <= 0.0 => least,
            _ if share >= 1.0 => largest,
            _ if self.log => least * (largest / least).powf(share),
            _ => least + share * (largest - least),
        }
    }

    /// The point of the unit interval that belongs to a value.
    pub fn share(&self, x: f64) -> f64 {
        let [least, largest] = self.ends;
        let found = match self.log {
            true if x * least <= 0.0 => 0.0,
            true => (x / least).ln() / (largest / least).ln(),
            false => (x - least) / (largest - least),
        };
        found.clamp(0.0, 1.0)
    }

    /// The derivative of the value by the share.
    pub fn rate(&self, x: f64) -> f64 {
        let [least, largest] = self.ends;
        if self.log {
            x * (largest / least).ln()
        } else {
            largest - least
        }
    }
}

/// The variables of the section.
pub fn bounds(loaded: &Loaded, section: &[(String, Written)]) -> Result<Vec<Bound>, Fault> {
    let Some(Written::Table(given)) = entry(section, "variables") else {
        return Err(Fault::new("there are no variables").hint("tick a parameter that may change"));
    };
    let mut found = Vec::new();
    for (name, of) in given {
        let names = &loaded.model.blueprint.parameters;
        let Some(place) = names.iter().position(|known| known == name) else {
            return Err(refused(&format!("'{name}', which is not a parameter")));
        };
        let Written::List(ends) = of else { return Err(refused("such bounds")) };
        let (least, largest) = (number(ends.first()), number(ends.get(1)));
        let log = ends.len() > 2;
        let ordered = least < largest; // false for what is not a number
        if !ordered || log && least * largest <= 0.0 {
            let message = format!("the bounds of {name} are {least} and {largest}");
            return Err(Fault::new(message).hint("the second must be larger"));
        }
        let before = loaded.model.parameters[place];
        found.push(Bound { name: name.clone(), ends: [least, largest], log, before });
    }
    Ok(found)
}
