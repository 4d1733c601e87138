//! The folder of the resources from a URI, as FMI 2.0 gives it, or from a path.

use std::path::PathBuf;

/// The path of a URI such as `file:///tmp/fmu/resources`, or of a path.
pub fn folder(location: &str) -> Result<PathBuf, String> {
    let Some(rest) = location.strip_prefix("file:") else {
        return Ok(PathBuf::from(location));
    };
    let path = match rest.strip_prefix("//") {
        // the host is empty or this machine
        Some(rest) => rest.strip_prefix("localhost").unwrap_or(rest),
        None => rest,
    };
    let decoded = decoded(path).ok_or_else(|| format!("{location} is not a URI of a folder"))?;
    // file:///C:/… is C:/…
    let of_drive = decoded.as_bytes().get(2) == Some(&b':') && cfg!(windows);
    Ok(PathBuf::from(if of_drive { &decoded[1..] } else { &decoded[..] }))
}

/// The text without percent encoding.
fn decoded(text: &str) -> Option<String> {
    let (bytes, mut found, mut k) = (text.as_bytes(), Vec::new(), 0);
    while k < bytes.len() {
        if bytes[k] == b'%' {
            let digits = text.get(k + 1..k + 3)?;
            found.push(u8::from_str_radix(digits, 16).ok()?);
            k += 3;
        } else {
            found.push(bytes[k]);
            k += 1;
        }
    }
    String::from_utf8(found).ok()
}

#[cfg(test)]
mod tests {
    use super::folder;
    use std::path::Path;

    #[test]
    fn uris_and_paths_give_folders() {
        let is =
            |text, wanted| assert_eq!(folder(text).as_deref(), Ok(Path::new(wanted)), "{text}");
        is("file:///tmp/a/resources", "/tmp/a/resources");
        is("file:/tmp/a", "/tmp/a");
        is("file://localhost/tmp/a", "/tmp/a");
        is("file:///tmp/a%20b%C3%A4/", "/tmp/a bä/");
        is("/tmp/a%20b", "/tmp/a%20b");
        assert!(folder("file:///tmp/%zz").is_err());
        assert!(folder("file:///tmp/%4").is_err());
        assert!(folder("file:///tmp/%ff").is_err());
    }
}
