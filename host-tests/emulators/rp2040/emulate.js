// A Raspberry Pi Pico with an ST7789 on SPI0:
//
//     node emulate.js ELF MEMORY [--frames N] [--lose-byte K] [--milliseconds LIMIT]
//
// Boots the firmware without a boot ROM, runs it until GPIO2 has fallen N times (2), and writes the
// panel's memory to the file MEMORY: 240 x 320 words of 16 bits, little-endian. Prints one line of
// JSON: what each frame took, the panel's registers, and what the panel took offence at. With
// --lose-byte the panel does not get the K-th byte of pixels, counted from 1.
//
// It always ends: after LIMIT milliseconds of the chip's time (4000), when the chip sleeps with
// nothing to wake it, or when the firmware panics; then with status 1 and a sentence on stderr.

import { readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { GPIOPinState, RP2040 } from 'rp2040js';
import { load } from './elf.js';
import { St7789 } from './st7789.js';

const MARKER = 2;
const DC = 16;
const CS = 17;
const RESET = 20;

/** The firmware runs the chip at 125 MHz. */
const NANOS_PER_CYCLE = 8;

const TIMER = 0x40054;
const TIMER_RAW_LOW = 0x28;

/** How far a look at the clock moves it before the first frame. */
const SKIPPED_NANOS = 20_000;

/** Where the boot ROM's stack is when it calls boot2. */
const BOOT_STACK = 0x20041f00;

function options() {
  const { positionals, values } = parseArgs({
    allowPositionals: true,
    options: {
      frames: { type: 'string', default: '2' },
      'lose-byte': { type: 'string', default: '0' },
      milliseconds: { type: 'string', default: '4000' },
    },
  });
  const number = (name) => {
    const value = Number(values[name]);
    if (!Number.isInteger(value) || value < 0) {
      throw new Error(`--${name} takes a number, not ${values[name]}`);
    }
    return value;
  };
  if (positionals.length !== 2) {
    throw new Error('two arguments are needed: ELF MEMORY');
  }
  const [elf, memory] = positionals;
  const [frames, loseByte] = [number('frames'), number('lose-byte')];
  return { elf, memory, frames, loseByte, limit: number('milliseconds') * 1e6 };
}

/** A chip with a program in flash, about to run boot2 as the boot ROM would start it. */
function boot(elf) {
  const chip = new RP2040();
  const quiet = () => {};
  // The emulator does nothing for SEV but to say so. A core that sends an event also registers it itself, which is how an
  // executor that has just been woken does not fall asleep.
  const info = (_, what) => {
    chip.core.eventRegistered ||= what === 'SEV';
  };
  chip.logger = { debug: quiet, info, warn: quiet, error: quiet };
  load(elf, chip.flash);
  chip.core.SP = BOOT_STACK;
  // Tells boot2 to go on to the program's vectors.
  chip.core.LR = 0;
  chip.core.PC = 0x10000000;
  return chip;
}

/**
 * Wires the panel to SPI0. A byte takes its time on the wire, eight clocks, and the panel takes it
 * with the last: chip select has to be low and D/C to hold all the while. (If bytes took no time,
 * it would not be seen when a program changes D/C while the last ones of a transfer are under way.)
 */
function connect(chip, panel) {
  const spi = chip.spi[0];
  const high = (pin) => chip.gpio[pin].value === GPIOPinState.High;
  let byte = 0;
  let underWay = false;
  const arrived = chip.clock.createAlarm(() => {
    underWay = false;
    panel.receive(byte, high(DC));
    spi.completeTransmit(0);
  });
  spi.onTransmit = (value) => {
    if (high(CS)) {
      panel.error('a byte while chip select is high');
    }
    if (spi.dataBits !== 8) {
      panel.error(`words of ${spi.dataBits} bits`);
    }
    byte = value;
    underWay = true;
    arrived.schedule(8e9 / spi.clockFrequency);
  };
  const holds = (pin, name) =>
    chip.gpio[pin].addListener(() => {
      if (underWay) {
        panel.error(`${name} changed within a byte`);
      }
    });
  holds(DC, 'D/C');
  holds(CS, 'chip select');
  chip.gpio[RESET].addListener((state) => {
    if (state === GPIOPinState.Low) {
      panel.reset();
    }
  });
}

/**
 * Makes waiting short: until `inFrames()`, each look at the microsecond timer moves the chip's clock
 * on. The 0.3 s that a panel's initialisation waits would be most of what there is to emulate.
 */
function skipDelays(chip, inFrames) {
  const timer = chip.peripherals[TIMER];
  const read = timer.readUint32.bind(timer);
  timer.readUint32 = (offset) => {
    if (offset === TIMER_RAW_LOW && !inFrames()) {
      chip.clock.tick(SKIPPED_NANOS);
    }
    return read(offset);
  };
}

/** Runs the chip until the marker has fallen `count` times; what each frame took. */
function run(chip, panel, { frames: count, limit }) {
  const { clock, core } = chip;
  const frames = [];
  let instructions = 0;
  let start;
  const now = () => ({ nanos: clock.nanos, instructions, pixels: panel.pixels });
  chip.gpio[MARKER].addListener((state) => {
    if (state === GPIOPinState.High) {
      start = now();
    } else if (start !== undefined) {
      const end = now();
      frames.push({
        cycles: Math.round((end.nanos - start.nanos) / NANOS_PER_CYCLE),
        instructions: end.instructions - start.instructions,
        pixels: end.pixels - start.pixels,
      });
    }
  });
  skipDelays(chip, () => start !== undefined);
  chip.onBreak = () => {
    throw new Error(`the firmware panicked (at 0x${core.PC.toString(16)})`);
  };
  while (frames.length < count) {
    if (clock.nanos > limit) {
      const did = `${frames.length} of ${count} frames`;
      throw new Error(`${did} after ${limit / 1e6} ms of the chip's time`);
    }
    if (!core.waiting) {
      const before = core.cycles;
      core.executeInstruction();
      instructions++;
      clock.tick((core.cycles - before) * NANOS_PER_CYCLE);
    } else if (clock.nextAlarm) {
      clock.tick(clock.nanosToNextAlarm);
    } else {
      throw new Error(`asleep for ever, after ${frames.length} of ${count} frames`);
    }
  }
  return frames;
}

function main() {
  const asked = options();
  const chip = boot(readFileSync(asked.elf));
  const panel = new St7789(asked);
  connect(chip, panel);
  const frames = run(chip, panel, asked);
  // Hosts that run this are little-endian.
  writeFileSync(asked.memory, new Uint8Array(panel.memory.buffer));
  const { on, asleep, inverted, colmod, errors } = panel;
  console.log(JSON.stringify({ frames, panel: { on, asleep, inverted, colmod, errors } }));
}

try {
  main();
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
