//! [`CacheFolder`]: where entries are kept, which files are believed, and how much they may take.
//!
//! What is in an entry is checked by `entry`. This file makes sure that nobody else can put one
//! there, and that nothing but a regular file of a plausible size is ever read: not a pipe, not
//! a device, not a link to something else.

use std::ffi::OsStr;
use std::fs::{self, File, Metadata};
use std::io::{self, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use tempfile::NamedTempFile;

use super::entry::{EntryKey, EntryKind, HEADER_BYTES, Payload};

/// What all entries may take together unless the user says otherwise, in bytes.
pub(crate) const SIZE_MAX_DEFAULT: u64 = 2 << 30;

/// Half-written files older than this were left behind by a process that was killed.
const ABANDONED_AFTER: Duration = Duration::from_secs(60 * 60);

/// How the names of half-written files begin.
const DRAFT_PREFIX: &str = "draft-";

/// A private folder of entries. Any number of processes may use it at the same time.
#[derive(Clone, Debug)]
pub(crate) struct CacheFolder {
    path: PathBuf,
    size_max: u64,
}

impl CacheFolder {
    /// The folder there, which is created private to the user.
    ///
    /// # Errors
    ///
    /// When it cannot be created, belongs to another user, or others may change what is in it.
    pub(crate) fn open(path: &Path) -> io::Result<Self> {
        create(path)?;
        // Checked where it really is: a link to it may change its mind.
        let path = path.canonicalize()?;
        check_folder(&path)?;
        Ok(Self {
            path,
            size_max: SIZE_MAX_DEFAULT,
        })
    }

    /// The same folder, with that much room for all entries together, in bytes.
    pub(crate) fn with_size_max(self, size_max: u64) -> Self {
        Self { size_max, ..self }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The entry of that identity, with its position at the payload, which is unread and
    /// unchecked. `None` when there is none that can be used; a useless one is removed.
    pub(crate) fn entry(&self, kind: EntryKind, key: &EntryKey) -> Option<(File, Payload)> {
        let path = self.path.join(key.file_name(kind));
        match read_header(&path, kind, key) {
            Ok(Some((file, payload))) => {
                // Used just now, so it is evicted last. It is used even when that fails.
                let _ = file.set_modified(SystemTime::now());
                Some((file, payload))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Ok(None) | Err(_) => {
                self.forget(kind, key);
                None
            }
        }
    }

    /// Removes an entry, which is damaged.
    pub(crate) fn forget(&self, kind: EntryKind, key: &EntryKey) {
        // If that fails, the next one replaces it.
        let _ = fs::remove_file(self.path.join(key.file_name(kind)));
    }

    /// A file to write an entry to, private to the user.
    pub(crate) fn draft(&self) -> io::Result<NamedTempFile> {
        tempfile::Builder::new()
            .prefix(DRAFT_PREFIX)
            .tempfile_in(&self.path)
    }

    /// Makes a complete file the entry of that identity, and makes room for it.
    pub(crate) fn keep(
        &self,
        draft: NamedTempFile,
        kind: EntryKind,
        key: &EntryKey,
    ) -> io::Result<File> {
        let file = draft.persist(self.path.join(key.file_name(kind)))?;
        // The entry is there; a folder that is too large is no reason to do without it.
        let _ = self.evict(SystemTime::now());
        Ok(file)
    }

    /// Removes the entries that were not used for the longest time until the rest fits.
    ///
    /// Several processes may do so at once. Each removes whole files, and who has opened one can
    /// still read it, so the worst that can happen is that a robot is compiled again.
    fn evict(&self, now: SystemTime) -> io::Result<()> {
        let mut kept = Vec::new();
        for entry in fs::read_dir(&self.path)? {
            let path = entry?.path();
            // Another process may have removed it.
            let Ok(metadata) = fs::symlink_metadata(&path) else {
                continue;
            };
            match purpose(&path) {
                Some(Purpose::Entry(kind)) if is_plausible(&metadata, kind) => {
                    kept.push((last_use(&metadata), metadata.len(), path));
                }
                Some(Purpose::Draft) if !is_abandoned(&metadata, now) => {}
                Some(Purpose::Entry(_) | Purpose::Draft) => {
                    let _ = fs::remove_file(&path);
                }
                // Not ours.
                None => {}
            }
        }
        let mut total: u64 = kept.iter().map(|(_, length, _)| length).sum();
        kept.sort();
        for (_, length, path) in kept {
            if total <= self.size_max {
                break;
            }
            let _ = fs::remove_file(path);
            total -= length;
        }
        Ok(())
    }
}

/// What a file of the folder is for, by its name.
enum Purpose {
    Entry(EntryKind),
    Draft,
}

fn purpose(path: &Path) -> Option<Purpose> {
    let extension = path.extension().and_then(OsStr::to_str);
    let mut kinds = EntryKind::ALL.into_iter();
    if let Some(kind) = kinds.find(|kind| extension == Some(kind.extension())) {
        return Some(Purpose::Entry(kind));
    }
    let name = path.file_name()?.to_str()?;
    name.starts_with(DRAFT_PREFIX).then_some(Purpose::Draft)
}

fn last_use(metadata: &Metadata) -> SystemTime {
    metadata.modified().unwrap_or(SystemTime::UNIX_EPOCH)
}

fn is_abandoned(metadata: &Metadata, now: SystemTime) -> bool {
    let age = now.duration_since(last_use(metadata));
    age.is_ok_and(|age| age > ABANDONED_AFTER)
}

/// Whether this can be an entry: a regular file of the user's, which nobody else may change, and
/// not larger than any entry is.
fn is_plausible(metadata: &Metadata, kind: EntryKind) -> bool {
    metadata.is_file()
        && (HEADER_BYTES..=HEADER_BYTES + kind.bytes_max()).contains(&metadata.len())
        && is_private(metadata)
}

fn read_header(
    path: &Path,
    kind: EntryKind,
    key: &EntryKey,
) -> io::Result<Option<(File, Payload)>> {
    let mut file = open(path)?;
    let metadata = file.metadata()?;
    if !is_plausible(&metadata, kind) {
        return Ok(None);
    }
    let Some(payload) = Payload::read(&mut file, kind, key)? else {
        return Ok(None);
    };
    if metadata.len() != HEADER_BYTES + payload.length {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(HEADER_BYTES))?;
    Ok(Some((file, payload)))
}

/// Opens what is there, without waiting and without following a link.
#[cfg(unix)]
fn open(path: &Path) -> io::Result<File> {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt as _;

    let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::NOCTTY;
    let flags = i32::try_from(flags.bits()).map_err(io::Error::other)?;
    File::options().read(true).custom_flags(flags).open(path)
}

#[cfg(not(unix))]
fn open(path: &Path) -> io::Result<File> {
    File::open(path)
}

#[cfg(unix)]
fn create(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::DirBuilderExt as _;

    fs::DirBuilder::new()
        .recursive(true)
        .mode(0o700)
        .create(path)
}

#[cfg(not(unix))]
fn create(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}

/// The bits of a mode that let group and others write.
#[cfg(unix)]
const OTHERS_WRITE: u32 = 0o022;

/// Whether a file is the user's, and nobody else may write to it.
#[cfg(unix)]
fn is_private(metadata: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    metadata.uid() == rustix::process::geteuid().as_raw() && metadata.mode() & OTHERS_WRITE == 0
}

#[cfg(not(unix))]
fn is_private(_: &Metadata) -> bool {
    true
}

#[cfg(unix)]
fn check_folder(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::MetadataExt as _;

    let metadata = fs::metadata(path)?;
    let mode = metadata.mode() & 0o777;
    if metadata.uid() != rustix::process::geteuid().as_raw() {
        return Err(io::Error::other(
            "it belongs to another user; name another folder",
        ));
    }
    if mode & OTHERS_WRITE != 0 {
        return Err(io::Error::other(format!(
            "others may write to it (mode {mode:o}); `chmod go-w` it or name another folder"
        )));
    }
    // Who may write to a folder above can put another one in its place, except where only the
    // owner of an entry may rename it, as in `/tmp`.
    for above in path.ancestors().skip(1) {
        let mode = fs::metadata(above)?.mode();
        if mode & 0o002 != 0 && mode & 0o1000 == 0 {
            return Err(io::Error::other(
                "everyone may write to a folder above it; name another folder",
            ));
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn check_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use wasmouse_core::Digest;

    use super::*;
    use crate::limits::Limits;
    use crate::runtime::new_compiler;

    fn keys(names: &[&str]) -> Vec<EntryKey> {
        let limits = Limits::default();
        let engine = new_compiler(&limits).expect("an engine");
        let key = |name: &&str| EntryKey::new(&engine, &limits, &Digest::of(name.as_bytes()));
        names.iter().map(key).collect()
    }

    fn keep(folder: &CacheFolder, key: &EntryKey, content: &[u8]) {
        let payload = Payload {
            length: content.len() as u64,
            digest: Digest::of(content),
        };
        let mut draft = folder.draft().expect("a draft");
        let header = payload.header(EntryKind::Code, key);
        draft.write_all(&header).expect("room");
        draft.write_all(content).expect("room");
        folder.keep(draft, EntryKind::Code, key).expect("kept");
    }

    fn has(folder: &CacheFolder, key: &EntryKey) -> bool {
        folder.path.join(key.file_name(EntryKind::Code)).exists()
    }

    fn set_age(folder: &CacheFolder, key: &EntryKey, seconds: u64) {
        let path = folder.path.join(key.file_name(EntryKind::Code));
        let file = File::options().write(true).open(path).expect("an entry");
        let time = SystemTime::now() - Duration::from_secs(seconds);
        file.set_modified(time).expect("my file");
    }

    /// A new folder with room for that many entries of 1,000 bytes.
    fn folder_for(entries: u64) -> (tempfile::TempDir, CacheFolder) {
        let parent = tempfile::tempdir().expect("a temporary folder");
        let folder = CacheFolder::open(&parent.path().join("cache")).expect("a new folder");
        (
            parent,
            folder.with_size_max(entries * (HEADER_BYTES + 1000)),
        )
    }

    #[test]
    fn the_entry_that_was_not_used_for_longest_makes_room() {
        let (_parent, folder) = folder_for(2);
        let keys = keys(&["a", "b", "c"]);
        keep(&folder, &keys[0], &[0; 1000]);
        keep(&folder, &keys[1], &[1; 1000]);
        set_age(&folder, &keys[0], 200);
        set_age(&folder, &keys[1], 100);
        // A use counts, not the order in which they were written.
        folder.entry(EntryKind::Code, &keys[0]).expect("an entry");
        keep(&folder, &keys[2], &[2; 1000]);
        assert!(has(&folder, &keys[0]) && has(&folder, &keys[2]));
        assert!(!has(&folder, &keys[1]));
        // One that is larger than the folder does not stay either.
        keep(&folder, &keys[1], &[1; 3000]);
        assert!(!has(&folder, &keys[1]));
    }

    #[test]
    fn what_processes_left_behind_is_removed_and_other_files_are_not() {
        let (_parent, folder) = folder_for(9);
        for name in ["draft-old", "draft-new", "mine.txt"] {
            fs::write(folder.path.join(name), "x").expect("a file");
        }
        let old = File::options()
            .write(true)
            .open(folder.path.join("draft-old"))
            .expect("a file");
        let long_ago = SystemTime::now() - 2 * ABANDONED_AFTER;
        old.set_modified(long_ago).expect("my file");
        keep(&folder, &keys(&["a"])[0], &[0; 10]);
        let exists = |name| folder.path.join(name).exists();
        assert!(!exists("draft-old"));
        assert!(exists("draft-new") && exists("mine.txt"));
    }

    #[test]
    fn many_threads_keep_and_evict_at_once() {
        let (_parent, folder) = folder_for(2);
        let keys = keys(&["a", "b", "c", "d"]);
        std::thread::scope(|scope| {
            for key in &keys {
                scope.spawn(|| {
                    for _ in 0..50 {
                        keep(&folder, key, &[7; 1000]);
                        if let Some((_, payload)) = folder.entry(EntryKind::Code, key) {
                            assert_eq!(payload.digest, Digest::of(&[7; 1000]));
                        }
                    }
                });
            }
        });
        folder.evict(SystemTime::now()).expect("a folder");
        let left = keys.iter().filter(|key| has(&folder, key)).count();
        assert!(left <= 2, "{left}");
    }
}
