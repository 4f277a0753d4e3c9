//! The manifest of the prebuilt robots, and the table made from it that the
//! host embeds.
//!
//! The manifest is for people and tests; the host reads nothing at run time.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// `example-robots/prebuilt/manifest.toml`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The version of this format.
    pub schema: u32,
    /// The robots, sorted by name.
    #[serde(default, rename = "robot")]
    pub robots: Vec<Entry>,
}

/// One prebuilt robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// The name on the command line; also that of its folder.
    pub name: String,
    /// The component, in the folder of the manifest.
    pub file: String,
    /// One sentence, from the robot's Cargo.toml.
    pub description: String,
    /// The size of the component. Unit: bytes.
    pub size_bytes: usize,
    /// SHA-256 of the component, lowercase hexadecimal.
    pub sha256: String,
    /// [`crate::sources::sources_sha256`] of the tree it was built from.
    pub sources_sha256: String,
    /// The compiler, as the component itself names it.
    pub toolchain: String,
    /// The values of `briefing.variant` that it takes.
    #[serde(default, rename = "variant")]
    pub variants: Vec<Variant>,
}

/// One value of `briefing.variant`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// The number that the robot gets.
    pub value: u32,
    /// A short name for the number.
    pub name: String,
    /// What it changes.
    pub description: String,
}

/// What a robot's Cargo.toml says about it.
#[derive(Debug, Deserialize)]
struct CargoManifest {
    package: Package,
}

#[derive(Debug, Deserialize)]
struct Package {
    description: Option<String>,
    #[serde(default)]
    metadata: Metadata,
}

#[derive(Debug, Default, Deserialize)]
struct Metadata {
    #[serde(default)]
    wasmouse: RobotMetadata,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotMetadata {
    #[serde(default, rename = "variant")]
    variants: Vec<Variant>,
}

/// The folder of the prebuilt robots.
pub fn folder(root: &Path) -> PathBuf {
    root.join("example-robots/prebuilt")
}

/// The table in the host's sources.
pub fn table_path(root: &Path) -> PathBuf {
    root.join("host/engine/src/bundled/table.rs")
}

impl Manifest {
    /// The version of the format.
    pub const SCHEMA: u32 = 2;

    /// Reads the manifest of the repository at `root`.
    ///
    /// # Errors
    ///
    /// When it cannot be read or understood.
    pub fn load(root: &Path) -> io::Result<Self> {
        let path = folder(root).join("manifest.toml");
        toml::from_str(&fs::read_to_string(&path)?).map_err(|error| invalid(&path, &error))
    }

    /// The manifest as a file.
    pub fn to_toml(&self) -> String {
        let body = toml::to_string(self).expect("plain data has a TOML form");
        format!(
            "# Written by `cargo xtask robots`, like the robots beside it; see CONTRIBUTING.md.\n{body}"
        )
    }

    /// The table that the host compiles in.
    pub fn to_rust(&self) -> String {
        let mut text = "//! The bundled robots. Written by `cargo xtask robots`, not by hand.\n\n\
             use super::robot::{BundledRobot, Variant};\n\n\
             pub(super) const ROBOTS: &[BundledRobot] = &["
            .to_owned();
        for robot in &self.robots {
            let Entry {
                name,
                file,
                description,
                sha256,
                ..
            } = robot;
            let variants: String = robot.variants.iter().map(Variant::to_rust).collect();
            write!(
                text,
                "BundledRobot {{ name: {name:?}, description: {description:?}, \
                 variants: &[{variants}], \
                 component: include_bytes!(\"../../../../example-robots/prebuilt/{file}\"), \
                 sha256: {sha256:?}, }},"
            )
            .expect("writing to a string");
        }
        text.push_str("];\n");
        text
    }
}

impl Variant {
    fn to_rust(&self) -> String {
        let Self {
            value,
            name,
            description,
        } = self;
        format!("Variant {{ value: {value}, name: {name:?}, description: {description:?}, }},")
    }
}

impl Entry {
    /// Describes a component of the robot `name`, built from the tree at `root`.
    ///
    /// # Errors
    ///
    /// When the robot's Cargo.toml lacks a description, when the component names
    /// no compiler, or when a source cannot be read.
    pub fn describe(root: &Path, name: &str, component: &[u8]) -> io::Result<Self> {
        let path = root.join("example-robots").join(name).join("Cargo.toml");
        let parsed: CargoManifest =
            toml::from_str(&fs::read_to_string(&path)?).map_err(|error| invalid(&path, &error))?;
        let description = parsed.package.description.ok_or_else(|| {
            invalid(
                &path,
                &"a bundled robot needs a `description` of one sentence",
            )
        })?;
        let toolchain = compiler_of(component)
            .ok_or_else(|| invalid(&path, &"the component does not say which rustc built it"))?;
        Ok(Self {
            name: name.to_owned(),
            file: format!("{name}.wasm"),
            description,
            size_bytes: component.len(),
            sha256: crate::sources::sha256(component),
            sources_sha256: crate::sources::sources_sha256(root, name)?,
            toolchain,
            variants: parsed.package.metadata.wasmouse.variants,
        })
    }
}

/// The compiler that a component's `producers` section names: there, the name
/// `rustc` and the version each follow a byte with their length.
fn compiler_of(component: &[u8]) -> Option<String> {
    const NAME: &[u8] = b"\x05rustc";
    let after = component
        .windows(NAME.len())
        .position(|window| window == NAME)?
        + NAME.len();
    let (&length, rest) = component.get(after..)?.split_first()?;
    let version = rest.get(..usize::from(length))?;
    Some(format!("rustc {}", std::str::from_utf8(version).ok()?))
}

fn invalid(path: &Path, error: &dyn std::fmt::Display) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidData,
        format!("{}: {error}", path.display()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest() -> Manifest {
        Manifest {
            schema: Manifest::SCHEMA,
            robots: vec![Entry {
                name: "flood".into(),
                file: "flood.wasm".into(),
                description: "Says \"hello\".".into(),
                size_bytes: 3,
                sha256: "aa".into(),
                sources_sha256: "bb".into(),
                toolchain: "rustc 1.95.0".into(),
                variants: vec![Variant {
                    value: 1,
                    name: "fast".into(),
                    description: "drives".into(),
                }],
            }],
        }
    }

    #[test]
    fn a_manifest_survives_its_file() {
        let text = manifest().to_toml();
        assert_eq!(toml::from_str::<Manifest>(&text).unwrap(), manifest());
        assert!(toml::from_str::<Manifest>("schema = 1\nrobots = 2").is_err());
    }

    #[test]
    fn the_table_quotes_text() {
        let table = manifest().to_rust();
        assert!(
            table.contains(r#"description: "Says \"hello\".""#),
            "{table}"
        );
        assert!(
            table.contains(r#"Variant { value: 1, name: "fast""#),
            "{table}"
        );
    }

    #[test]
    fn the_compiler_is_read_from_the_component() {
        let component = b"\x0cprocessed-by\x01\x05rustc\x061.95.0rest";
        assert_eq!(compiler_of(component), Some("rustc 1.95.0".into()));
        assert_eq!(compiler_of(b"\x05rustc\x09short"), None);
        assert_eq!(compiler_of(b""), None);
    }
}
