//! Every public type can be logged by defmt, and written by serde.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use quote::ToTokens;
use syn::{Attribute, Ident, Item, UseTree, Visibility};

/// Types without serde: ends of a queue, pins, what is under way on a line, classifiers that contain functions, a tally whose cells are
/// written one by one, a table whose cells lie elsewhere, and tables and searches that
/// are not finished.
const UNWRITTEN: [&str; 19] = [
    "BoundarySlice",
    "BoundarySliceMaker",
    "BoundaryTableMaker",
    "ClassLines",
    "Confident",
    "CriticalSpeedSearch",
    "Decoder",
    "Encoder",
    "Inlet",
    "Instrument",
    "NoLines",
    "Outlet",
    "PerParticle",
    "Queue",
    "Receiver",
    "RestitutionTableMaker",
    "Sender",
    "SizedTally",
    "Station",
];

/// A name in a module: the path from the root of the crate.
type Place = Vec<String>;

/// What the source states of types.
#[derive(Default)]
struct Types {
    /// Attributes of each declared type, as text.
    declared: BTreeMap<Place, String>,
    /// What a public name of a module stands for.
    exported: BTreeMap<Place, Place>,
    public_modules: BTreeSet<Place>,
    /// Traits implemented by hand, with the names of the types they are implemented for.
    implemented: BTreeSet<(String, String)>,
}

impl Types {
    fn read(folder: &Path) -> Self {
        let mut types = Self::default();
        types.read_folder(folder, &[]);
        types
    }

    fn read_folder(&mut self, folder: &Path, module: &[String]) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            if path.is_dir() {
                self.read_folder(&path, &[module, &[name]].concat());
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let items = syn::parse_file(&std::fs::read_to_string(&path).unwrap()).unwrap().items;
                let own = if name == "mod" || name == "lib" { Vec::new() } else { vec![name] };
                self.read_items(&items, &[module, &own].concat());
            }
        }
    }

    fn read_items(&mut self, items: &[Item], module: &[String]) {
        let public = |visibility: &Visibility| matches!(visibility, Visibility::Public(_));
        let place = |name: &Ident| [module, &[name.to_string()]].concat();
        for item in items {
            match item {
                Item::Struct(item) if public(&item.vis) => self.declare(place(&item.ident), &item.attrs),
                Item::Enum(item) if public(&item.vis) => self.declare(place(&item.ident), &item.attrs),
                Item::Mod(item) if public(&item.vis) => drop(self.public_modules.insert(place(&item.ident))),
                Item::Use(item) if public(&item.vis) => self.export(&item.tree, module, module),
                Item::Impl(item) => {
                    if let (Some((_, path, _)), syn::Type::Path(of)) = (&item.trait_, &*item.self_ty) {
                        let last = |path: &syn::Path| path.segments.last().unwrap().ident.to_string();
                        self.implemented.insert((last(path), last(&of.path)));
                    }
                }
                _ => {}
            }
        }
    }

    fn declare(&mut self, place: Place, attributes: &[Attribute]) {
        let text = attributes.iter().map(|attribute| attribute.to_token_stream().to_string()).collect();
        self.declared.insert(place, text);
    }

    /// Exports the names of a `use` in `module`, whose tree stands below the path `from`.
    fn export(&mut self, tree: &UseTree, module: &[String], from: &[String]) {
        let below = |from: &[String], name: &Ident| [from, &[name.to_string()]].concat();
        match tree {
            UseTree::Path(path) => {
                let from = match path.ident.to_string().as_str() {
                    "crate" => Vec::new(),
                    "self" => from.to_vec(),
                    "super" => from[..from.len() - 1].to_vec(),
                    _ => below(from, &path.ident),
                };
                self.export(&path.tree, module, &from);
            }
            UseTree::Name(name) => drop(self.exported.insert(below(module, &name.ident), below(from, &name.ident))),
            UseTree::Rename(rename) => {
                self.exported.insert(below(module, &rename.rename), below(from, &rename.ident));
            }
            UseTree::Group(group) => group.items.iter().for_each(|item| self.export(item, module, from)),
            UseTree::Glob(_) => panic!("the test does not follow globs"),
        }
    }

    /// Types that another crate can name.
    fn public(&self) -> BTreeSet<&Place> {
        let in_public_module = |place: &Place| {
            let modules = &place[..place.len() - 1];
            (1..=modules.len()).all(|depth| self.public_modules.contains(&modules[..depth]))
        };
        let exported = self.exported.keys().filter(|place| in_public_module(place)).map(|mut place| {
            while let Some(of) = self.exported.get(place) {
                place = of;
            }
            place
        });
        let declared = self.declared.keys().filter(|place| in_public_module(place));
        declared.chain(exported.filter(|place| self.declared.contains_key(*place))).collect()
    }

    /// Public types that neither derive a trait nor have it by hand.
    fn without(&self, name: &str, derived: &str) -> Vec<&str> {
        let lacks = |place: &&Place| {
            let by_hand = (name.to_owned(), last(place).to_owned());
            !self.declared[*place].contains(derived) && !self.implemented.contains(&by_hand)
        };
        self.public().into_iter().filter(lacks).map(last).collect()
    }
}

/// The name of a place, without its module.
fn last(place: &Place) -> &str {
    place.last().map_or("", String::as_str)
}

#[test]
fn every_public_type_has_its_formats() {
    let types = Types::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../src"));
    let public = types.public().len();
    assert!(public > 100, "{public}");
    assert_eq!(types.without("Format", "defmt :: Format"), [""; 0]);
    let mut unwritten = types.without("Serialize", "serde :: Serialize");
    unwritten.sort_unstable();
    assert_eq!(unwritten, UNWRITTEN);
}
