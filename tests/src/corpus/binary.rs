//! Sections of WebAssembly binaries, for what the text format cannot express, and bytes for
//! the text format.

/// A section with that number and content.
pub fn section(number: u8, content: &[u8]) -> Vec<u8> {
    let mut section = vec![number];
    section.extend(leb128(content.len()));
    section.extend_from_slice(content);
    section
}

/// A custom section.
pub fn custom(name: &str, content: &[u8]) -> Vec<u8> {
    let mut body = leb128(name.len());
    body.extend_from_slice(name.as_bytes());
    body.extend_from_slice(content);
    section(0, &body)
}

/// A number as WebAssembly writes it.
pub fn leb128(mut value: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let low = u8::try_from(value & 0x7f).expect("seven bits");
        value >>= 7;
        if value == 0 {
            bytes.push(low);
            return bytes;
        }
        bytes.push(low | 0x80);
    }
}

/// Bytes as the text format has them.
pub fn escaped(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("\\{byte:02x}")).collect()
}
