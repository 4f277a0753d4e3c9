//! [`Shell`]: a component with a place for a robot in it, and what answers WASI beside it.
//!
//! `cargo xtask wasi` builds the shells; `host/engine/wasi` has their sources. A shell imports
//! what robots may import, and nothing else. A robot is put in as it is, so its code, its names
//! and its debug information stay what they are.

use wasm_encoder::{
    Component, ComponentAliasSection, ComponentExportKind, ComponentInstanceSection, RawSection,
};
use wasmparser::{
    BinaryReader, ComponentAlias, ComponentAliasSectionReader, ComponentExternalKind,
    ComponentImportSectionReader, ComponentInstanceSectionReader, ComponentTypeRef,
};

/// The adapter that answers `wasi_snapshot_preview1` in a core module.
pub(super) const ADAPTER: &[u8] = include_bytes!("../../wasi/prebuilt/adapter.wasm");

/// Its world.
pub(super) const ADAPTER_WIT: &str = include_str!("../../wasi/wit/adapter.wit");

/// The shell of robots with that adapter.
pub(super) const PREVIEW1: Shell = Shell {
    bytes: include_bytes!("../../wasi/prebuilt/preview1.wasm"),
};

/// The shell of components that import preview 2.
pub(super) const PREVIEW2: Shell = Shell {
    bytes: include_bytes!("../../wasi/prebuilt/preview2.wasm"),
};

/// Magic number and version.
const HEADER_BYTES: usize = 8;

/// The number of the component in a shell that stands for the robot: the one after what answers
/// WASI.
const COMPONENTS: usize = 2;

/// Numbers of sections in a component.
pub(super) mod section {
    pub(in super::super) const COMPONENT: u8 = 4;
    pub(in super::super) const INSTANCE: u8 = 5;
    pub(in super::super) const ALIAS: u8 = 6;
    pub(in super::super) const IMPORT: u8 = 10;
    pub(in super::super) const EXPORT: u8 = 11;
}

/// A component with a place for a robot.
///
/// Its second component is empty and stands for the robot. The sections that follow it
/// instantiate that component and take the controller from the instance: they are written again
/// for each robot, because they have its names in them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shell {
    bytes: &'static [u8],
}

impl Shell {
    /// The shell with a robot in it.
    ///
    /// `argument` gives for an import of the robot the name of an instance of the shell: one that
    /// it imports, or takes from what answers WASI. Nothing else is passed to the robot, and
    /// imports without an argument are missing in what is returned, which is then not valid.
    /// `controller` is the name under which the robot exports its controller.
    pub(super) fn with_robot<'a>(
        self,
        robot: &[u8],
        arguments: impl IntoIterator<Item = (&'a str, String)>,
        controller: &str,
    ) -> Vec<u8> {
        let mut instances: Vec<String> = Vec::new();
        let mut component = Component::new();
        let mut components = 0;
        let mut arguments = Some(arguments);
        let mut alias_is_due = false;
        for (id, data) in sections(self.bytes) {
            components += usize::from(id == section::COMPONENT);
            if components < COMPONENTS {
                add_names(id, data, &mut instances);
                component.section(&RawSection { id, data });
            } else if id == section::COMPONENT && components == COMPONENTS {
                component.section(&RawSection { id, data: robot });
            } else if id == section::INSTANCE
                && let Some(arguments) = arguments.take()
            {
                let mut instance = ComponentInstanceSection::new();
                let arguments = arguments.into_iter().filter_map(|(name, of)| {
                    let index = instances.iter().position(|it| *it == of)?;
                    Some((name, ComponentExportKind::Instance, number(index)))
                });
                instance.instantiate(number(COMPONENTS - 1), Vec::from_iter(arguments));
                component.section(&instance);
                alias_is_due = true;
            } else if id == section::ALIAS && alias_is_due {
                alias_is_due = false;
                let mut alias = ComponentAliasSection::new();
                alias.alias(wasm_encoder::Alias::InstanceExport {
                    instance: number(instances.len()),
                    kind: ComponentExportKind::Instance,
                    name: controller,
                });
                component.section(&alias);
            } else {
                component.section(&RawSection { id, data });
            }
        }
        component.finish()
    }

    /// The names of the instances that a robot can be given.
    pub(super) fn instances(self) -> Vec<String> {
        let mut names = Vec::new();
        let mut components = 0;
        for (id, data) in sections(self.bytes) {
            components += usize::from(id == section::COMPONENT);
            if components < COMPONENTS {
                add_names(id, data, &mut names);
            }
        }
        names.retain(|name: &String| !name.is_empty());
        names
    }
}

/// The outermost sections of a module or component of ours, with their numbers.
pub(super) fn sections(bytes: &[u8]) -> impl Iterator<Item = (u8, &[u8])> {
    let mut reader = BinaryReader::new(bytes.get(HEADER_BYTES..).unwrap_or_default(), 0);
    std::iter::from_fn(move || {
        let id = reader.read_u8().ok()?;
        let length = reader.read_var_u32().ok()?;
        let data = reader.read_bytes(usize::try_from(length).ok()?).ok()?;
        Some((id, data))
    })
}

/// Adds the names of the instances that a section of a shell defines, in the order of their
/// indices; those without a name get an empty one.
fn add_names(id: u8, data: &[u8], names: &mut Vec<String>) {
    let reader = BinaryReader::new(data, 0);
    match id {
        section::IMPORT => {
            let section = ComponentImportSectionReader::new(reader);
            for import in section.into_iter().flatten().flatten() {
                if matches!(import.ty, ComponentTypeRef::Instance(_)) {
                    names.push(import.name.name.to_owned());
                }
            }
        }
        section::INSTANCE => {
            let section = ComponentInstanceSectionReader::new(reader);
            let count = section.map_or(0, |it| it.count());
            names.extend((0..count).map(|_| String::new()));
        }
        section::ALIAS => {
            let section = ComponentAliasSectionReader::new(reader);
            for alias in section.into_iter().flatten().flatten() {
                if let ComponentAlias::InstanceExport {
                    kind: ComponentExternalKind::Instance,
                    name,
                    ..
                } = alias
                {
                    names.push(name.to_owned());
                }
            }
        }
        _ => {}
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).expect("a shell has few items")
}
