// An ST7789 as its serial interface shows it: commands and pixels in, memory out.
//
// Strict: what a careful driver does not send is noted as an error.

export const WIDTH = 240;
export const HEIGHT = 320;

/** What memory holds before anything is written: magenta, so that it is seen. */
const UNWRITTEN = 0xf81f;

/** COLMOD for 16 bits a pixel on the serial interface. */
const RGB565 = 0x55;

const ERRORS_KEPT = 10;

export class St7789 {
  constructor({ loseByte = 0 } = {}) {
    this.memory = new Uint16Array(WIDTH * HEIGHT).fill(UNWRITTEN);
    this.errors = [];
    /** Pixels written since power-on. */
    this.pixels = 0;
    /** Bytes of pixels received since power-on, and which of them is lost (from 1; 0 is none). */
    this.pixelBytes = 0;
    this.loseByte = loseByte;
    this.reset();
  }

  /** The registers after a reset; the memory stays. */
  reset() {
    this.on = false;
    this.asleep = true;
    this.inverted = false;
    this.colmod = 0x66;
    this.columns = [0, WIDTH - 1];
    this.rows = [0, HEIGHT - 1];
    [this.x, this.y] = [0, 0];
    this.command = 0x00;
    this.parameters = [];
  }

  error(text) {
    if (this.errors.length < ERRORS_KEPT) {
      this.errors.push(text);
    }
  }

  /** Takes a byte. */
  receive(byte, isData) {
    if (isData) {
      this.data(byte);
    } else {
      this.command = byte;
      this.parameters = [];
      this.execute();
    }
  }

  execute() {
    switch (this.command) {
      case 0x00: // NOP
      case 0x13: // NORON
      case 0x2a: // CASET
      case 0x2b: // RASET
      case 0x36: // MADCTL
      case 0x3a: // COLMOD
      case 0x3c: // RAMWRC: goes on where the last write stopped
        break;
      case 0x01: // SWRESET
        this.reset();
        break;
      case 0x10: // SLPIN
        this.asleep = true;
        break;
      case 0x11: // SLPOUT
        this.asleep = false;
        break;
      case 0x20: // INVOFF
        this.inverted = false;
        break;
      case 0x21: // INVON
        this.inverted = true;
        break;
      case 0x28: // DISPOFF
        this.on = false;
        break;
      case 0x29: // DISPON
        this.on = true;
        break;
      case 0x2c: // RAMWR: starts at the window's corner
        [this.x, this.y] = [this.columns[0], this.rows[0]];
        break;
      default:
        this.error(`command 0x${this.command.toString(16)} is not modelled`);
    }
  }

  data(byte) {
    switch (this.command) {
      case 0x2a:
        this.columns = this.range('CASET', byte, WIDTH) ?? this.columns;
        break;
      case 0x2b:
        this.rows = this.range('RASET', byte, HEIGHT) ?? this.rows;
        break;
      case 0x36:
        if (byte !== 0) {
          this.error(`MADCTL 0x${byte.toString(16)}: only RGB from the top left is modelled`);
        }
        break;
      case 0x3a:
        this.colmod = byte;
        break;
      case 0x2c:
      case 0x3c:
        this.pixelByte(byte);
        break;
      default:
        this.error(`data for command 0x${this.command.toString(16)}, which takes none`);
    }
  }

  /** First and last of a window's side, big-endian, once the fourth byte is there. */
  range(name, byte, limit) {
    this.parameters.push(byte);
    if (this.parameters.length !== 4) {
      return undefined;
    }
    const [a, b, c, d] = this.parameters;
    const [first, last] = [(a << 8) | b, (c << 8) | d];
    if (first > last || last >= limit) {
      this.error(`${name} ${first} to ${last}`);
      return undefined;
    }
    return [first, last];
  }

  /** A byte of a pixel, the high one first. Pixels go row by row, and wrap in the window. */
  pixelByte(byte) {
    this.pixelBytes++;
    if (this.pixelBytes === this.loseByte) {
      return;
    }
    if (this.colmod !== RGB565) {
      this.error(`a pixel while COLMOD is 0x${this.colmod.toString(16)}`);
    }
    this.parameters.push(byte);
    if (this.parameters.length < 2) {
      return;
    }
    const [high, low] = this.parameters;
    this.parameters = [];
    this.memory[this.y * WIDTH + this.x] = (high << 8) | low;
    this.pixels++;
    this.x++;
    if (this.x > this.columns[1]) {
      this.x = this.columns[0];
      this.y++;
    }
    if (this.y > this.rows[1]) {
      this.y = this.rows[0];
    }
  }
}
