//! [`Abi`]: what the canonical ABI makes of the world `robot`.

use wit_bindgen_core::wit_parser::abi::{AbiVariant, WasmType};
use wit_bindgen_core::wit_parser::{
    Docs, Function, InterfaceId, PackageId, Resolve, SizeAlign, Type, TypeDefKind, TypeId,
};

/// The binary interface.
pub struct Abi {
    /// The version of the package.
    pub version: String,
    /// All types, those that others have in them first.
    pub types: Vec<Named>,
    /// The functions that a robot exports.
    pub controller: Interface,
    /// The functions that a robot may import.
    pub journal: Interface,
}

/// An interface with functions.
pub struct Interface {
    /// The full name, with the version.
    pub name: String,
    /// In the order of the WIT.
    pub functions: Vec<FlatFunction>,
}

/// A function as a core module has it.
pub struct FlatFunction {
    /// As in the WIT.
    pub name: String,
    pub docs: String,
    /// As in the WIT, with what each becomes.
    pub parameters: Vec<Parameter>,
    /// The type to whose address the function returns a pointer.
    pub result: Option<String>,
}

/// A parameter of the WIT.
pub struct Parameter {
    pub name: String,
    pub ty: Shape,
    /// The numbers that it becomes.
    pub flat: Vec<Flat>,
}

/// A number among the parameters of a core function.
pub struct Flat {
    /// The way to it: `goal`, `origin`, `x`.
    pub path: Vec<String>,
    pub ty: Shape,
    pub docs: String,
}

impl Flat {
    /// `goal.origin.x`.
    pub fn dotted(&self) -> String {
        self.path.join(".")
    }

    /// `i32` or `i64`.
    pub fn core(&self) -> &'static str {
        match self.ty {
            Shape::U64 => "i64",
            _ => "i32",
        }
    }
}

/// A type of the WIT that the interface uses.
#[derive(Clone, PartialEq, Eq)]
pub enum Shape {
    U32,
    U64,
    S8,
    /// The address of text; its length is a number of its own.
    Address,
    /// The length of text, in bytes.
    Length,
    String,
    /// An enumeration or record by its name.
    Named(String),
}

/// A type with a name.
pub struct Named {
    pub name: String,
    pub docs: String,
    pub kind: Kind,
    /// Size in memory, in bytes.
    pub size: usize,
}

/// What a named type is.
pub enum Kind {
    /// The names are numbered from 0.
    Enumeration(Vec<(String, String)>),
    Record(Vec<Field>),
    /// One byte with the number of the case, and then what one of the cases has.
    Variant {
        cases: Vec<(String, String)>,
        /// The case that has fields, and these.
        payload: (usize, Vec<Field>),
    },
}

/// A field in memory.
pub struct Field {
    pub name: String,
    pub docs: String,
    pub ty: Shape,
    /// From the beginning of the type, in bytes.
    pub offset: usize,
    /// In bytes.
    pub size: usize,
}

impl Abi {
    /// Reads the text of the WIT package.
    ///
    /// # Errors
    ///
    /// What is not valid, or has no place in the header and on the page.
    pub fn read(wit: &str) -> Result<Self, String> {
        let mut resolve = Resolve::default();
        let package = resolve
            .push_str("robot.wit", wit)
            .map_err(|error| format!("{error:#}"))?;
        let mut sizes = SizeAlign::default();
        sizes.fill(&resolve);
        let reader = Reader { resolve, sizes };
        reader.abi(package)
    }

    /// The named type.
    pub fn named(&self, name: &str) -> &Named {
        let found = self.types.iter().find(|it| it.name == name);
        found.unwrap_or_else(|| panic!("the type `{name}` is one of the interface"))
    }
}

struct Reader {
    resolve: Resolve,
    sizes: SizeAlign,
}

impl Reader {
    fn abi(&self, package: PackageId) -> Result<Abi, String> {
        let package = &self.resolve.packages[package];
        let version = package.name.version.as_ref().ok_or("no version")?;
        let interface = |name: &str| {
            let id = package.interfaces.get(name).copied();
            id.ok_or_else(|| format!("no interface `{name}`"))
        };
        let mut types = Vec::new();
        for interface in ["types", "controller", "journal"].map(interface) {
            for (name, id) in &self.resolve.interfaces[interface?].types {
                // What an interface takes from another was read with that one.
                if !matches!(self.resolve.types[*id].kind, TypeDefKind::Type(_)) {
                    types.push(self.named(name, *id)?);
                }
            }
        }
        Ok(Abi {
            version: version.to_string(),
            types,
            controller: self.interface(interface("controller")?, AbiVariant::GuestExport)?,
            journal: self.interface(interface("journal")?, AbiVariant::GuestImport)?,
        })
    }

    fn interface(&self, id: InterfaceId, variant: AbiVariant) -> Result<Interface, String> {
        let functions = self.resolve.interfaces[id].functions.values();
        Ok(Interface {
            name: self
                .resolve
                .id_of(id)
                .ok_or("an interface without a name")?,
            functions: functions
                .map(|it| self.function(it, variant))
                .collect::<Result<_, String>>()?,
        })
    }

    fn function(&self, function: &Function, variant: AbiVariant) -> Result<FlatFunction, String> {
        let mut parameters = Vec::new();
        for parameter in &function.params {
            let mut flat = Vec::new();
            // The only parameter needs no name: `dimension` is that of the briefing.
            let path = match function.params.as_slice() {
                [_] if self.fields(&parameter.ty).is_some() => Vec::new(),
                _ => vec![parameter.name.clone()],
            };
            self.flatten(&path, &parameter.ty, "", &mut flat)?;
            parameters.push(Parameter {
                name: parameter.name.clone(),
                ty: self.shape(&parameter.ty)?,
                flat,
            });
        }
        let result = match &function.result {
            Some(ty) => match self.shape(ty)? {
                Shape::Named(name) => Some(name),
                _ => return Err(format!("`{}` returns a number", function.name)),
            },
            None => None,
        };
        let signature = self.resolve.wasm_signature(variant, function);
        let expected = signature.params.iter().map(|it| match it {
            WasmType::I64 | WasmType::PointerOrI64 => "i64",
            _ => "i32",
        });
        let found = parameters.iter().flat_map(|it| &it.flat).map(Flat::core);
        if !expected.eq(found) || signature.retptr != result.is_some() {
            return Err(format!("`{}` has another signature", function.name));
        }
        Ok(FlatFunction {
            name: function.name.clone(),
            docs: text(&function.docs),
            parameters,
            result,
        })
    }

    /// The fields of a record.
    fn fields(&self, ty: &Type) -> Option<&[wit_bindgen_core::wit_parser::Field]> {
        match &self.resolve.types[self.definition(ty)?].kind {
            TypeDefKind::Record(record) => Some(&record.fields),
            _ => None,
        }
    }

    /// Where a type is defined that has a name.
    fn definition(&self, ty: &Type) -> Option<TypeId> {
        let Type::Id(mut id) = *ty else {
            return None;
        };
        while let TypeDefKind::Type(Type::Id(other)) = self.resolve.types[id].kind {
            id = other;
        }
        Some(id)
    }

    fn flatten(
        &self,
        path: &[String],
        ty: &Type,
        docs: &str,
        flat: &mut Vec<Flat>,
    ) -> Result<(), String> {
        if let Some(fields) = self.fields(ty) {
            for field in fields {
                let path = [path, std::slice::from_ref(&field.name)].concat();
                let docs = format!("{docs}\n{}", text(&field.docs));
                self.flatten(&path, &field.ty, docs.trim(), flat)?;
            }
            return Ok(());
        }
        let mut push = |path: Vec<String>, ty, docs: &str| {
            let docs = docs.to_owned();
            flat.push(Flat { path, ty, docs });
        };
        match self.shape(ty)? {
            Shape::String => {
                push(path.to_vec(), Shape::Address, "Address of the text.");
                let length = [path, &["length".to_owned()]].concat();
                push(length, Shape::Length, "Length of the text. Unit: bytes.");
            }
            shape => {
                // What has no words of its own has those of its type.
                let of_type = match (docs, self.definition(ty)) {
                    ("", Some(id)) => text(&self.resolve.types[id].docs),
                    _ => String::new(),
                };
                push(path.to_vec(), shape, &format!("{docs}{of_type}"));
            }
        }
        Ok(())
    }

    fn shape(&self, ty: &Type) -> Result<Shape, String> {
        Ok(match ty {
            Type::U32 => Shape::U32,
            Type::U64 => Shape::U64,
            Type::S8 => Shape::S8,
            Type::String => Shape::String,
            _ => {
                let id = self
                    .definition(ty)
                    .ok_or_else(|| format!("the type {ty:?}"))?;
                let name = self.resolve.types[id].name.clone();
                Shape::Named(name.ok_or("a type without a name")?)
            }
        })
    }

    fn named(&self, name: &str, id: TypeId) -> Result<Named, String> {
        let definition = &self.resolve.types[id];
        let fields = |fields: &[wit_bindgen_core::wit_parser::Field], begin: usize| {
            let offsets = self.sizes.field_offsets(fields.iter().map(|it| &it.ty));
            let fields = fields.iter().zip(offsets);
            fields
                .map(|(field, (offset, _))| {
                    Ok(Field {
                        name: field.name.clone(),
                        docs: text(&field.docs),
                        ty: self.shape(&field.ty)?,
                        offset: begin + offset.size_wasm32(),
                        size: self.sizes.size(&field.ty).size_wasm32(),
                    })
                })
                .collect::<Result<Vec<Field>, String>>()
        };
        let kind = match &definition.kind {
            TypeDefKind::Enum(it) => Kind::Enumeration(
                it.cases
                    .iter()
                    .map(|case| (case.name.clone(), text(&case.docs)))
                    .collect(),
            ),
            TypeDefKind::Record(it) => Kind::Record(fields(&it.fields, 0)?),
            TypeDefKind::Variant(it) => {
                let begin = self
                    .sizes
                    .payload_offset(it.tag(), it.cases.iter().map(|case| case.ty.as_ref()))
                    .size_wasm32();
                let cases = it.cases.iter();
                let mut payloads = cases
                    .clone()
                    .enumerate()
                    .filter_map(|(number, case)| Some((number, self.fields(case.ty.as_ref()?)?)));
                let (Some((number, payload)), None) = (payloads.next(), payloads.next()) else {
                    return Err(format!("`{name}` does not have one case with fields"));
                };
                Kind::Variant {
                    cases: cases
                        .map(|case| (case.name.clone(), text(&case.docs)))
                        .collect(),
                    payload: (number, fields(payload, begin)?),
                }
            }
            _ => return Err(format!("the type `{name}` is of another kind")),
        };
        Ok(Named {
            name: name.to_owned(),
            docs: text(&definition.docs),
            kind,
            size: self.sizes.size(&Type::Id(id)).size_wasm32(),
        })
    }
}

/// Documentation as text, with names as in C: `briefing.longest_move`.
fn text(docs: &Docs) -> String {
    let contents = docs.contents.as_deref().unwrap_or_default().trim();
    let parts = contents.split('`').enumerate().map(|(number, part)| {
        let is_name = number % 2 == 1
            && part.starts_with(|c: char| c.is_ascii_lowercase())
            && part
                .chars()
                .all(|c| c.is_ascii_lowercase() || "-.".contains(c));
        if is_name {
            part.replace('-', "_")
        } else {
            part.to_owned()
        }
    });
    parts.collect::<Vec<String>>().join("`")
}
