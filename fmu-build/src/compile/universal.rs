//! Libraries for several processors in one file, which macOS takes apart by itself: the fat form of Mach-O.

use crate::error::{Error, Result};

/// First bytes of a library for one processor, 64 bits, little-endian.
const THIN: [u8; 4] = 0xfeed_facf_u32.to_le_bytes();
/// First bytes of a library for several processors.
const FAT: [u8; 4] = 0xcafe_babe_u32.to_be_bytes();
/// Each library begins at a multiple of 2^14 bytes: the largest page of the processors.
const ALIGNMENT: u32 = 14;
/// Bytes of the header, and of its entry for one processor.
const HEADER: usize = 8;
const ENTRY: usize = 20;

/// One file of these libraries, in this order; a single one as it is. `name` is for errors.
///
/// # Errors
/// If one is no library for macOS, or they are too long for the format.
pub fn join(name: &str, libraries: Vec<Vec<u8>>) -> Result<Vec<u8>> {
    let libraries = match <[_; 1]>::try_from(libraries) {
        Ok([library]) => return Ok(library),
        Err(libraries) => libraries,
    };
    let refused = |reason: &str| Error::Document { document: format!("{name} for macOS"), reason: reason.to_owned() };
    let number = |value: usize| u32::try_from(value).map_err(|_| refused("4 GB is the limit of the format"));
    let mut header = [FAT, number(libraries.len())?.to_be_bytes()].concat();
    let mut body: Vec<u8> = Vec::new();
    let begin = (HEADER + ENTRY * libraries.len()).next_multiple_of(1 << ALIGNMENT);
    for library in &libraries {
        // The processor and its kind stand behind the first bytes, in the byte order of the processor.
        let (Some(THIN), Some(processor), Some(kind)) = (word(library, 0), word(library, 1), word(library, 2)) else {
            return Err(refused("a library does not begin like one"));
        };
        body.resize(body.len().next_multiple_of(1 << ALIGNMENT), 0);
        let (position, size) = (number(begin + body.len())?, number(library.len())?);
        for word in [u32::from_le_bytes(processor), u32::from_le_bytes(kind), position, size, ALIGNMENT] {
            header.extend(word.to_be_bytes());
        }
        body.extend(library);
    }
    header.resize(begin, 0);
    header.append(&mut body);
    Ok(header)
}

/// The `index`-th four bytes.
fn word(library: &[u8], index: usize) -> Option<[u8; 4]> {
    library.chunks_exact(4).nth(index)?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use object::read::macho::{FatArch, MachOFatFile32};

    use super::*;

    fn thin(processor: u32, length: usize) -> Vec<u8> {
        let mut library = [THIN, processor.to_le_bytes(), 3_u32.to_le_bytes()].concat();
        library.resize(length, 7);
        library
    }

    #[test]
    fn each_processor_finds_its_library() {
        let libraries = [thin(0x0100_0007, 20_000), thin(0x0100_000c, 100)];
        let joined = join("unit", libraries.to_vec()).unwrap();
        let file = MachOFatFile32::parse(joined.as_slice()).unwrap();
        let found: Vec<_> =
            file.arches().iter().map(|arch| (arch.cputype().0, arch.data(joined.as_slice()).unwrap())).collect();
        assert_eq!(found, [(0x0100_0007, libraries[0].as_slice()), (0x0100_000c, libraries[1].as_slice())]);
        assert!(file.arches().iter().all(|arch| u64::from(arch.offset()) % (1 << arch.align()) == 0));
    }

    #[test]
    fn what_is_no_library_is_refused() {
        for other in [b"\x7fELF and more".to_vec(), Vec::new(), THIN.to_vec()] {
            let error = join("uam_plant", vec![thin(7, 100), other]).unwrap_err().to_string();
            assert!(error.contains("uam_plant for macOS") && error.contains("does not begin"), "{error}");
        }
    }
}
