//! The modules of a crate and what each of them imports.
//!
//! Files are found by following `mod` from `lib.rs`, and a path is followed through
//! re-exports to the module that defines what it names. Items under `#[cfg(test)]`
//! are left out. In the arguments of macros and attributes, paths are found token
//! by token, except in braces (`use a::{b, c}`). What a macro expands to is not
//! seen, and neither is a method call, which names no module.

use std::collections::{BTreeMap, BTreeSet};
use std::slice;

use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{
    Attribute, Expr, ExprLit, ImplItem, Item, ItemMod, ItemUse, Lit, Macro, MetaList, UseTree,
};

/// Source files by their path in the folder of `lib.rs`.
pub type Files = BTreeMap<String, String>;

/// The modules of a crate.
#[derive(Debug, Default)]
pub struct Tree {
    /// The root comes first.
    pub modules: Vec<Module>,
    /// Files that could not be read.
    pub problems: Vec<String>,
}

/// A module: a file or a block in one.
#[derive(Debug, Default)]
pub struct Module {
    /// Its file, from the folder of `lib.rs`.
    pub file: String,
    /// The path of the file's module; a module written inside it has the same.
    pub place: Vec<String>,
    /// Modules in it, as indices into those of the tree.
    pub children: BTreeMap<String, usize>,
    /// What is defined here, and whether it is a constant. Macros end in `!`.
    pub items: BTreeMap<String, bool>,
    path: Vec<String>,
    parent: usize,
    written: Vec<Written>,
}

/// A path as it is written; the last name of a macro call ends in `!`.
#[derive(Debug)]
pub struct Written {
    /// The first line of the path.
    pub line: usize,
    names: Vec<String>,
    /// The name that it brings into the module, or `*`.
    binds: Option<String>,
}

/// What a path names, after all re-exports.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A module itself.
    Module(usize),
    /// An item, and the module that defines it.
    Item(usize, String),
    /// A path in another crate.
    Outside(String),
}

/// Paths that are being followed, by module and index: a path cannot pass through
/// itself, so that `use serde::serde` ends.
type Active = Vec<(usize, usize)>;

impl Tree {
    pub fn read(files: &Files) -> Self {
        let mut tree = Self::default();
        tree.modules.push(Module::default());
        tree.file(0, "lib.rs", files);
        tree
    }

    fn file(&mut self, module: usize, file: &str, files: &Files) {
        file.clone_into(&mut self.modules[module].file);
        match files.get(file).map(|text| syn::parse_file(text)) {
            Some(Ok(parsed)) => self.items(module, &parsed.items, files),
            Some(Err(error)) => self.problems.push(format!("{file}: {error}")),
            None => self.problems.push(format!("{file}: not found")),
        }
    }

    fn items(&mut self, module: usize, items: &[Item], files: &Files) {
        for item in items {
            let (name, attributes) = name_and_attributes(item);
            match item {
                _ if is_test(attributes) => {}
                Item::Mod(item) => self.child(module, item, files),
                _ => {
                    let is_constant = matches!(item, Item::Const(_));
                    let here = &mut self.modules[module];
                    here.items.extend(name.map(|name| (name, is_constant)));
                    here.visit_item(item);
                }
            }
        }
    }

    fn child(&mut self, parent: usize, item: &ItemMod, files: &Files) {
        let above = &self.modules[parent];
        let name = item.ident.to_string();
        let path = [&above.path[..], slice::from_ref(&name)].concat();
        let own_folder = path.join("/");
        let file = match (path_attribute(&item.attrs), above.file.rsplit_once('/')) {
            (Some(file), Some((folder, _))) => format!("{folder}/{file}"),
            (Some(file), None) => file,
            _ if files.contains_key(&format!("{own_folder}.rs")) => format!("{own_folder}.rs"),
            _ => format!("{own_folder}/mod.rs"),
        };
        let module = Module {
            file: above.file.clone(),
            place: above.place.clone(),
            path: path.clone(),
            parent,
            ..Module::default()
        };
        // Modules of one name, each for a platform, count as one.
        let index = self.modules.len();
        let index = *self.modules[parent].children.entry(name).or_insert(index);
        if index == self.modules.len() {
            self.modules.push(module);
        }
        if let Some((_, items)) = &item.content {
            self.items(index, items, files);
        } else {
            self.modules[index].place = path;
            self.file(index, &file, files);
        }
    }

    /// What each file names, at the first place where it does.
    pub fn imports(&self) -> Vec<(&Module, &Written, Target)> {
        let mut imports = Vec::new();
        let mut seen = BTreeSet::new();
        for (index, from) in self.modules.iter().enumerate() {
            for (position, written) in from.written.iter().enumerate() {
                for target in self.resolve(index, &written.names, &mut vec![(index, position)]) {
                    if seen.insert((&from.file, target.clone(), written.is_glob())) {
                        imports.push((from, written, target));
                    }
                }
            }
        }
        imports
    }

    fn resolve(&self, from: usize, path: &[String], active: &mut Active) -> Vec<Target> {
        let parent = |module: usize| Target::Module(self.modules[module].parent);
        let mut found = match path[0].as_str() {
            "crate" => vec![Target::Module(0)],
            "self" => vec![Target::Module(from)],
            "super" => vec![parent(from)],
            name => self.lookup(from, name, active),
        };
        if found.is_empty() && path[0].ends_with('!') && from != 0 {
            // A macro is visible in the modules below the one that defines it.
            return self.resolve(self.modules[from].parent, path, active);
        }
        if found.is_empty() {
            found.push(Target::Outside(path[0].clone()));
        }
        for name in &path[1..] {
            let mut next = Vec::new();
            for target in found {
                match target {
                    Target::Module(module) if name == "super" => next.push(parent(module)),
                    Target::Module(module) => {
                        let inner = self.lookup(module, name, active);
                        // What is not found there, a macro makes.
                        let is_made = inner.is_empty();
                        next.extend(inner);
                        next.extend(is_made.then(|| Target::Item(module, name.clone())));
                    }
                    Target::Item(..) => next.push(target),
                    Target::Outside(path) => next.push(Target::Outside(format!("{path}::{name}"))),
                }
            }
            found = next;
        }
        found
    }

    fn lookup(&self, module: usize, name: &str, active: &mut Active) -> Vec<Target> {
        let here = &self.modules[module];
        let child = here.children.get(name).map(|child| Target::Module(*child));
        let item = here.items.get(name);
        let item = item.map(|_| Target::Item(module, name.to_owned()));
        let mut found: Vec<Target> = child.into_iter().chain(item).collect();
        for binds in [name.trim_end_matches('!'), "*"] {
            if binds == "*" && !found.is_empty() {
                break;
            }
            for (position, written) in here.written.iter().enumerate() {
                let is_active = active.contains(&(module, position));
                if is_active || written.binds.as_deref() != Some(binds) {
                    continue;
                }
                active.push((module, position));
                for target in self.resolve(module, &written.names, active) {
                    match target {
                        _ if !written.is_glob() => found.push(target),
                        Target::Module(inner) => found.extend(self.lookup(inner, name, active)),
                        _ => {}
                    }
                }
                active.pop();
            }
        }
        found
    }
}

impl Written {
    /// Whether it imports everything in what it names.
    pub fn is_glob(&self) -> bool {
        self.binds.as_deref() == Some("*")
    }
}

impl Module {
    fn write(&mut self, path: &[&Ident], mark: &str, binds: Option<String>) {
        let mut names: Vec<String> = path.iter().map(ToString::to_string).collect();
        names.last_mut().expect("a path has a name").push_str(mark);
        let line = path[0].span().start().line;
        self.written.push(Written { line, names, binds });
    }

    fn use_tree<'a>(&mut self, tree: &'a UseTree, above: &[&'a Ident]) {
        let with = |name: &'a Ident| [above, &[name]].concat();
        let (name, alias) = match tree {
            UseTree::Path(it) => return self.use_tree(&it.tree, &with(&it.ident)),
            UseTree::Group(it) => return it.items.iter().for_each(|it| self.use_tree(it, above)),
            UseTree::Glob(_) => return self.write(above, "", Some("*".to_owned())),
            UseTree::Name(it) => (&it.ident, None),
            UseTree::Rename(it) => (&it.ident, Some(&it.rename)),
        };
        let path = if name == "self" { above } else { &with(name) };
        let name = alias.or(path.last().copied()).map(ToString::to_string);
        self.write(path, "", name);
    }

    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let is_sign = |at: usize, sign| matches!(tokens.get(at), Some(TokenTree::Punct(it)) if it.as_char() == sign);
        let mut path = Vec::new();
        for (at, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => {
                    path.clear();
                    self.tokens(group.stream());
                }
                TokenTree::Ident(name) => {
                    path.push(name);
                    let is_call = matches!(tokens.get(at + 2), Some(TokenTree::Group(_)));
                    if is_sign(at + 1, '!') && is_call {
                        self.write(&path, "!", None);
                    } else if is_sign(at + 1, ':') && is_sign(at + 2, ':') {
                        continue;
                    } else if path.len() > 1 {
                        self.write(&path, "", None);
                    }
                    path.clear();
                }
                _ if is_sign(at, ':') => {}
                _ => path.clear(),
            }
        }
    }
}

impl Visit<'_> for Module {
    fn visit_item(&mut self, item: &Item) {
        if !is_test(name_and_attributes(item).1) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &ImplItem) {
        if !matches!(item, ImplItem::Fn(function) if is_test(&function.attrs)) {
            visit::visit_impl_item(self, item);
        }
    }

    /// `pub(in crate::a)` imports nothing.
    fn visit_vis_restricted(&mut self, _: &syn::VisRestricted) {}

    fn visit_item_use(&mut self, item: &ItemUse) {
        self.use_tree(&item.tree, &[]);
    }

    /// A single name comes from a `use` or from the module itself.
    fn visit_path(&mut self, path: &syn::Path) {
        let names: Vec<&Ident> = path.segments.iter().map(|it| &it.ident).collect();
        if names.len() > 1 {
            self.write(&names, "", None);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &Macro) {
        let names: Vec<&Ident> = call.path.segments.iter().map(|it| &it.ident).collect();
        self.write(&names, "!", None);
        self.tokens(call.tokens.clone());
    }

    fn visit_meta_list(&mut self, list: &MetaList) {
        self.tokens(list.tokens.clone());
    }
}

fn name_and_attributes(item: &Item) -> (Option<String>, &[Attribute]) {
    let (name, attributes) = match item {
        Item::Const(it) => (&it.ident, &it.attrs),
        Item::Enum(it) => (&it.ident, &it.attrs),
        Item::Fn(it) => (&it.sig.ident, &it.attrs),
        Item::Mod(it) => (&it.ident, &it.attrs),
        Item::Static(it) => (&it.ident, &it.attrs),
        Item::Struct(it) => (&it.ident, &it.attrs),
        Item::Trait(it) => (&it.ident, &it.attrs),
        Item::Type(it) => (&it.ident, &it.attrs),
        Item::Union(it) => (&it.ident, &it.attrs),
        Item::Macro(it) => return (it.ident.as_ref().map(|name| format!("{name}!")), &it.attrs),
        Item::Impl(it) => return (None, &it.attrs),
        Item::Use(it) => return (None, &it.attrs),
        _ => return (None, &[]),
    };
    (Some(name.to_string()), attributes)
}

/// Whether the item exists only in tests or for a fuzzer: there is a `#[cfg(test)]`,
/// `#[cfg(all(test, ...))]`, `#[cfg(fuzzing)]` or `#[cfg(any(test, fuzzing))]`.
fn is_test(attributes: &[Attribute]) -> bool {
    let mut conditions = attributes.iter().filter(|it| it.path().is_ident("cfg"));
    conditions.any(|attribute| {
        let condition = attribute.meta.require_list();
        let condition = condition.map_or(String::new(), |list| list.tokens.to_string());
        let condition = condition.replace(' ', "");
        let only = ["test", "fuzzing", "any(test,fuzzing)"];
        only.contains(&condition.as_str()) || condition.starts_with("all(test,")
    })
}

/// The file that a `#[path = "..."]` names.
fn path_attribute(attributes: &[Attribute]) -> Option<String> {
    let attribute = attributes.iter().find(|it| it.path().is_ident("path"))?;
    match &attribute.meta.require_name_value().ok()?.value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}
