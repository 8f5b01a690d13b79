//! Every public type can be logged by defmt, and written by serde.

use std::collections::BTreeSet;
use std::path::Path;

use quote::ToTokens;
use syn::{Attribute, Ident, Item, UseTree, Visibility};

/// Types without serde: ends of a queue, pins, what is under way on a line, and a table whose cells lie elsewhere.
const UNWRITTEN: [&str; 10] = [
    "BoundarySlice",
    "ClassLines",
    "Decoder",
    "Encoder",
    "Inlet",
    "Instrument",
    "NoLines",
    "Queue",
    "Receiver",
    "Sender",
];

/// What the source says of types.
#[derive(Default)]
struct Types {
    /// Declared with their attributes as text.
    declared: Vec<(String, String)>,
    exported: BTreeSet<String>,
    /// Traits implemented by hand, with the types they are implemented for.
    implemented: BTreeSet<(String, String)>,
}

impl Types {
    fn read(folder: &Path) -> Self {
        let mut types = Self::default();
        types.read_folder(folder);
        types
    }

    fn read_folder(&mut self, folder: &Path) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                self.read_folder(&path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                self.read_items(&syn::parse_file(&std::fs::read_to_string(&path).unwrap()).unwrap().items);
            }
        }
    }

    fn read_items(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Struct(item) => self.declare(&item.vis, &item.ident, &item.attrs),
                Item::Enum(item) => self.declare(&item.vis, &item.ident, &item.attrs),
                Item::Use(item) if matches!(item.vis, Visibility::Public(_)) => self.export(&item.tree),
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

    fn declare(&mut self, visibility: &Visibility, name: &Ident, attributes: &[Attribute]) {
        if matches!(visibility, Visibility::Public(_)) {
            let text = attributes.iter().map(|attribute| attribute.to_token_stream().to_string());
            self.declared.push((name.to_string(), text.collect()));
        }
    }

    fn export(&mut self, tree: &UseTree) {
        match tree {
            UseTree::Path(path) => self.export(&path.tree),
            UseTree::Name(name) => drop(self.exported.insert(name.ident.to_string())),
            UseTree::Rename(rename) => drop(self.exported.insert(rename.ident.to_string())),
            UseTree::Group(group) => group.items.iter().for_each(|item| self.export(item)),
            UseTree::Glob(_) => panic!("the test does not follow globs"),
        }
    }

    /// Public types that neither derive a trait nor have it by hand.
    fn without(&self, name: &str, derived: &str) -> Vec<&str> {
        let has = |(of, attributes): &(String, String)| {
            attributes.contains(derived) || self.implemented.contains(&(name.to_owned(), of.clone()))
        };
        let public = self.declared.iter().filter(|(of, _)| self.exported.contains(of));
        public.filter(|declared| !has(declared)).map(|(of, _)| of.as_str()).collect()
    }
}

#[test]
fn every_public_type_has_its_formats() {
    let types = Types::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../src"));
    let public = types.declared.iter().filter(|(of, _)| types.exported.contains(of)).count();
    assert!(public > 100, "{public}");
    assert_eq!(types.without("Format", "defmt :: Format"), [""; 0]);
    let mut unwritten = types.without("Serialize", "serde :: Serialize");
    unwritten.sort_unstable();
    assert_eq!(unwritten, UNWRITTEN);
}
