// Loading an RP2040 ELF file into flash.

const FLASH_START = 0x10000000;
const FLASH_END = 0x11000000;
const BOOT2_SIZE = 256;
const SEGMENT_LOAD = 1;
const MACHINE_ARM = 40;

/** The loadable segments of an ELF file for Arm: `{ address, bytes }`, by load address. */
function segments(elf) {
  const isElf = elf.length >= 52 && elf.readUInt32BE(0) === 0x7f454c46;
  if (!isElf || elf.readUInt16LE(18) !== MACHINE_ARM) {
    throw new Error('not an ELF file for Arm');
  }
  const start = elf.readUInt32LE(28);
  const size = elf.readUInt16LE(42);
  const count = elf.readUInt16LE(44);
  const headers = Array.from({ length: count }, (_, i) => start + i * size);
  return headers
    .map((at) => ({
      type: elf.readUInt32LE(at),
      offset: elf.readUInt32LE(at + 4),
      address: elf.readUInt32LE(at + 12),
      length: elf.readUInt32LE(at + 16),
    }))
    .filter(({ type, length }) => type === SEGMENT_LOAD && length > 0)
    .map(({ offset, address, length }) => ({
      address,
      bytes: elf.subarray(offset, offset + length),
    }));
}

/** The checksum that the boot ROM wants behind the first 252 bytes: CRC-32/MPEG-2. */
function checksum(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) {
      crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
    }
  }
  return crc >>> 0;
}

/** Writes an ELF file into flash. Throws where the boot ROM of a real chip would not start it. */
export function load(elf, flash) {
  for (const { address, bytes } of segments(elf)) {
    if (address < FLASH_START || address + bytes.length > FLASH_END) {
      throw new Error(`a segment is loaded to 0x${address.toString(16)}, outside of flash`);
    }
    flash.set(bytes, address - FLASH_START);
  }
  const boot2 = flash.subarray(0, BOOT2_SIZE - 4);
  const stored = new DataView(flash.buffer, flash.byteOffset).getUint32(BOOT2_SIZE - 4, true);
  if (checksum(boot2) !== stored) {
    throw new Error("the checksum of the flash's first 256 bytes (boot2) is wrong");
  }
}
