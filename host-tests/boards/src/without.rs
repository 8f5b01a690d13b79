//! A source without some of its parts: every item that names one of them is taken out, and what names an item taken out,
//! until nothing is left that does.
//!
//! A part is a module, or a type or method by its name. Names that a `use` brought from a part count in its file alone.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{File, ImplItem, Item, UseTree};

/// What a source is to be without.
#[derive(Clone, Default)]
pub struct Parts<'a> {
    /// Names of modules.
    pub modules: Vec<&'a str>,
    /// Names of types.
    pub types: Vec<&'a str>,
    /// Names of methods.
    pub methods: Vec<&'a str>,
}

/// What is taken out so far.
#[derive(Clone, PartialEq, Eq)]
struct Taken {
    modules: BTreeSet<String>,
    /// Types and methods, wherever they are named.
    names: BTreeSet<String>,
    /// Functions, where they are called.
    functions: BTreeSet<String>,
}

/// Copies the files below `from` to `to`, those in Rust without some parts.
pub fn copy(from: &Path, to: &Path, parts: &Parts<'_>) -> Result<(), String> {
    let (mut files, mut others) = (BTreeMap::new(), Vec::new());
    read(from, Path::new(""), &parts.modules, &mut files, &mut others)?;
    take_out(&mut files, parts);
    let others = others.into_iter().map(|path| {
        let text = fs::read_to_string(from.join(&path));
        text.map(|text| (path.clone(), text)).map_err(|error| format!("{}: {error}", from.join(&path).display()))
    });
    let texts = files.into_iter().map(|(path, file)| Ok((path, file.to_token_stream().to_string())));
    for file in texts.chain(others) {
        let (path, text) = file?;
        let path = to.join(path);
        let wrong = |error: std::io::Error| format!("cannot write {}: {error}", path.display());
        fs::create_dir_all(path.parent().unwrap_or(to)).map_err(wrong)?;
        fs::write(&path, text).map_err(wrong)?;
    }
    Ok(())
}

/// Takes the parts out of parsed files.
pub fn take_out(files: &mut BTreeMap<PathBuf, File>, parts: &Parts<'_>) {
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let mut taken = Taken { modules: owned(&parts.modules), names: owned(&parts.types), functions: BTreeSet::new() };
    taken.names.extend(owned(&parts.methods));
    if !(taken.modules.is_empty() && taken.names.is_empty()) {
        loop {
            let before = taken.clone();
            for file in files.values_mut() {
                strip(file, &mut taken);
            }
            if taken == before {
                break;
            }
        }
    }
}

/// Parses the files of all modules but those to be without, and lists the files that are not in Rust.
fn read(
    root: &Path,
    below: &Path,
    without: &[&str],
    files: &mut BTreeMap<PathBuf, File>,
    others: &mut Vec<PathBuf>,
) -> Result<(), String> {
    let folder = root.join(below);
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(&folder).map_err(|error| wrong(&error))? {
        let entry = entry.map_err(|error| wrong(&error))?;
        let path = below.join(entry.file_name());
        if path.file_stem().is_some_and(|stem| without.iter().any(|module| stem == *module)) {
            continue;
        }
        if entry.path().is_dir() {
            read(root, &path, without, files, others)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(entry.path()).map_err(|error| wrong(&error))?;
            files.insert(path, syn::parse_file(&text).map_err(|error| wrong(&error))?);
        } else {
            others.push(path);
        }
    }
    Ok(())
}

/// Takes items out of a file, once.
fn strip(file: &mut File, taken: &mut Taken) {
    // What the file itself names, by what it imports.
    let mut here = taken.clone();
    let mut imported = BTreeSet::new();
    for item in &mut file.items {
        if let Item::Use(item) = item {
            prune(&mut item.tree, false, taken, &mut imported);
        }
    }
    here.functions.extend(imported.iter().filter(|name| !is_type(name)).cloned());
    here.names.extend(imported.into_iter().filter(|name| is_type(name)));
    file.items.retain_mut(|item| match item {
        Item::Use(item) => !is_empty(&item.tree),
        Item::Mod(item) => !taken.modules.contains(&item.ident.to_string()),
        Item::Impl(item) if item.trait_.is_none() => {
            let mut header = item.clone();
            header.items.clear();
            if here.names_any(header.to_token_stream()) {
                return false;
            }
            item.items.retain(|member| match member {
                ImplItem::Fn(method) => !here.names_any(method.to_token_stream()),
                ImplItem::Const(constant) => !here.names_any(constant.to_token_stream()),
                _ => true,
            });
            true
        }
        item => {
            let named = here.names_any(item.to_token_stream());
            if named && let Some(name) = name(item) {
                let known = if is_type(&name) { &mut taken.names } else { &mut taken.functions };
                known.insert(name);
            }
            !named
        }
    });
}

impl Taken {
    /// Whether a piece of source names anything that is taken out.
    fn names_any(&self, source: TokenStream) -> bool {
        let tokens: Vec<TokenTree> = source.into_iter().collect();
        tokens.iter().enumerate().any(|(place, token)| match token {
            TokenTree::Group(group) => self.names_any(group.stream()),
            TokenTree::Ident(ident) => {
                let name = ident.to_string();
                let after = tokens.get(place + 1..).unwrap_or_default();
                let in_path = matches!(after, [TokenTree::Punct(first), TokenTree::Punct(second), ..]
                    if (first.as_char(), second.as_char()) == (':', ':'));
                // A method, and the definition of another function of the name, are none of these functions.
                let is_free = !matches!(place.checked_sub(1).and_then(|before| tokens.get(before)),
                    Some(before) if [".", "fn"].contains(&&*before.to_string()));
                let has_arguments = matches!(after.first(),
                    Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
                let is_called = is_free && (in_path || has_arguments);
                self.names.contains(&name)
                    || self.functions.contains(&name) && is_called
                    || self.modules.contains(&name) && in_path
            }
            _ => false,
        })
    }
}

/// Takes out of a `use` what leads to a part; `gone` says that the path to here does. Collects the names that are gone.
fn prune(tree: &mut UseTree, gone: bool, taken: &Taken, imported: &mut BTreeSet<String>) {
    let is_gone = |name: &str| taken.names.contains(name) || taken.functions.contains(name);
    match tree {
        UseTree::Path(path) => {
            let gone = gone || taken.modules.contains(&path.ident.to_string());
            prune(&mut path.tree, gone, taken, imported);
            if is_empty(&path.tree) {
                *tree = nothing();
            }
        }
        UseTree::Group(group) => {
            let items = std::mem::take(&mut group.items);
            for mut item in items {
                prune(&mut item, gone, taken, imported);
                if !is_empty(&item) {
                    group.items.push(item);
                }
            }
        }
        UseTree::Name(leaf) => {
            let name = leaf.ident.to_string();
            if gone || is_gone(&name) || taken.modules.contains(&name) {
                imported.insert(name);
                *tree = nothing();
            }
        }
        UseTree::Rename(leaf) => {
            if gone || is_gone(&leaf.ident.to_string()) {
                imported.insert(leaf.rename.to_string());
                *tree = nothing();
            }
        }
        UseTree::Glob(_) => {
            if gone {
                *tree = nothing();
            }
        }
    }
}

fn nothing() -> UseTree {
    UseTree::Group(syn::UseGroup { brace_token: Default::default(), items: Default::default() })
}

fn is_empty(tree: &UseTree) -> bool {
    matches!(tree, UseTree::Group(group) if group.items.is_empty())
}

fn is_type(name: &str) -> bool {
    name.starts_with(char::is_uppercase)
}

fn name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Struct(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Const(item) => &item.ident,
        Item::Static(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        _ => return None,
    };
    Some(ident.to_string())
}
