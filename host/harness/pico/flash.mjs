// The flash chip of a Pico (W25Q16JV) behind the SSI, and the boot ROM: what it checks, loads, and offers.
import {FLASH, gateFlash, RAM} from './strict.mjs';

const SIZE = 2 * 1024 * 1024;
const SECTOR = 4096;
const PAGE = 256;
const ERASE_NS = 45e6; // W25Q16JV data sheet, 9.6: typical
const PROGRAM_NS = 0.4e6;
const WEAR_LIMIT = 100000;
const BOOT2 = 256;
const BOOT2_AT = 0x20041f00;

/** The CRC of a second-stage bootloader: RP2040 data sheet, 2.8.1.3.1. */
export function crcOfBoot2(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let i = 0; i < 8; i++) crc = (crc << 1) ^ (crc & 0x80000000 ? 0x04c11db7 : 0);
  }
  return crc >>> 0;
}

const view = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.length);

/** What a drag and drop onto the drive RPI-RP2 writes. Throws for what the boot ROM ignores. */
export function blocksOf(uf2) {
  const words = view(uf2);
  const blocks = [];
  if (uf2.length === 0 || uf2.length % 512) throw new Error('not a UF2 file: not blocks of 512 bytes');
  for (let at = 0; at < uf2.length; at += 512) {
    const word = (i) => words.getUint32(at + 4 * i, true);
    const say = (what) => new Error(`block ${at / 512}: ${what}`);
    if (word(0) !== 0x0a324655 || word(1) !== 0x9e5d5157 || word(127) !== 0x0ab16f30)
      throw say('no UF2 magic');
    if (word(2) & 1) continue; // not for the main flash
    if (!(word(2) & 0x2000) || word(7) !== 0xe48bff56) throw say('not of the family RP2040');
    if (word(4) !== PAGE || word(3) % PAGE) throw say('not a page of 256 bytes');
    if (word(3) < FLASH || word(3) + PAGE > FLASH + SIZE) throw say('not an address of the flash');
    if (word(6) !== uf2.length / 512) throw say('another number of blocks');
    blocks.push({address: word(3), bytes: uf2.subarray(at + 32, at + 32 + PAGE)});
  }
  return blocks;
}

/** The contents of a flash chip; it outlives resets of the processor. */
export class Flash {
  bytes = new Uint8Array(SIZE).fill(0xff);
  wear = new Map(); // erasures by sector
  worn = new Set(); // sectors that do not keep what is written
  quad = false; // QE of status register 2; kept without power
  /** Bytes until the power fails during an erasure or a page; Infinity: it does not. */
  powerFor = Infinity;
  onPowerLost = () => {};

  constructor(number = 1) {
    this.id = Uint8Array.of(0xe6, 0x60, 0x58, 0x38, number >> 24, number >> 16, number >> 8, number);
  }
  load(uf2) {
    for (const {address, bytes} of blocksOf(uf2)) this.bytes.set(bytes, address - FLASH);
  }
  erase(at) {
    this.wear.set(at, (this.wear.get(at) ?? 0) + 1);
    for (let i = 0; i < SECTOR; i++) if (!this.#store(at + i, 0xff)) return;
    if (this.wear.get(at) > WEAR_LIMIT) this.worn.add(at);
  }
  program(at, bytes) {
    for (let i = 0; i < bytes.length; i++) {
      const stuck = this.worn.has(at + i - ((at + i) % SECTOR)) && i % 5 === 0 ? 0x10 : 0;
      if (!this.#store(at + i, this.bytes[at + i] & (bytes[i] | stuck))) return;
    }
  }
  #store(at, value) {
    if (this.powerFor-- <= 0) {
      this.onPowerLost();
      return false;
    }
    this.bytes[at] = value;
    return true;
  }
}

/** The SSI: the commands that a second-stage bootloader gives to the flash chip, and whether reads then work. */
class Ssi {
  name = 'XIP_SSI';
  #registers = new Map();
  #command = [];
  #answers = [];
  #writable = false;
  #continuous = false;
  constructor(flash, switchReads, chip) {
    this.flash = flash;
    this.switchReads = switchReads;
    this.chip = chip;
  }
  get #frame() {
    return this.#registers.get(0x00) ?? 0;
  }
  readUint32(offset) {
    if (offset === 0x28) {
      this.#command = []; // nothing is left to send, so the flash chip is deselected
      return 0x6 | (this.#answers.length ? 8 : 0);
    }
    if (offset === 0x60) return this.#answers.shift() ?? 0;
    if (offset === 0x58) return 0x51535049;
    return this.#registers.get(offset) ?? 0;
  }
  writeUint32Atomic(offset, value, kind) {
    if (kind !== 0)
      value = [
        value,
        this.readUint32(offset) ^ value,
        this.readUint32(offset) | value,
        this.readUint32(offset) & ~value,
      ][kind];
    this.#registers.set(offset, value >>> 0);
    if (offset === 0x60) this.#send(value >>> 0);
    if (offset === 0x08) this.#enable(value & 1);
  }
  #send(word) {
    const transmit = ((this.#frame >> 8) & 3) === 0;
    if (!(this.#registers.get(0x08) & 1)) return this.chip.sin('the SSI sends while it is off');
    if (!transmit) {
      // The first read of a continuous read mode: command, then address and mode bits on four lines.
      this.#command.push(word);
      if (this.#command.length === 2 && this.#command[0] === 0xeb && this.flash.quad)
        this.#continuous = (word & 0xff) >> 4 === 0xa;
      if (this.#command.length === 2) this.#answers.push(0xffffffff);
      return;
    }
    this.#command.push(word & 0xff);
    this.#answers.push(this.#answer());
  }
  #answer() {
    const [command, data] = this.#command;
    const first = this.#command.length === 1;
    if (first && command === 0x06) this.#writable = true;
    if (first) return 0;
    if (command === 0x05) return this.#writable ? 2 : 0;
    // Four bytes of pause, then the number of the chip.
    if (command === 0x4b && this.#command.length > 5) return this.flash.id[this.#command.length - 6] ?? 0;
    if (command === 0x35) return this.flash.quad ? 2 : 0;
    if (command === 0x31 && this.#command.length === 2 && this.#writable) {
      this.flash.quad = (data & 2) !== 0;
      this.#writable = false;
    }
    return 0;
  }
  /** Reads over the XIP window need 32-bit frames that are read after command and address. */
  #enable(on) {
    this.#command = [];
    if (!on) return this.switchReads(false);
    const spi = this.#registers.get(0xf4) ?? 0;
    const reads = ((this.#frame >> 8) & 3) === 3 && ((this.#frame >> 16) & 31) === 31;
    const lines = (this.#frame >> 21) & 3;
    const [command, wait, size, address, kind] = [
      spi >>> 24,
      (spi >> 11) & 31,
      (spi >> 8) & 3,
      (spi >> 2) & 15,
      spi & 3,
    ];
    const serial = lines === 0 && command === 3 && wait === 0 && size === 2 && address === 6 && kind === 0;
    const quad = lines === 2 && command === 0xa0 && wait === 4 && size === 0 && address === 8 && kind === 2;
    const divider = this.#registers.get(0x14) ?? 0;
    const timed = divider >= 2 && divider % 2 === 0;
    this.switchReads(reads && timed && ((serial && !this.#continuous) || (quad && this.#continuous)));
  }
  /** What the boot ROM sets up: serial reads. */
  readSerially() {
    this.#continuous = false;
    for (const [offset, value] of [
      [0x08, 0],
      [0x14, 4],
      [0x00, 0x001f0300],
      [0xf4, 0x03000218],
      [0x08, 1],
    ])
      this.writeUint32Atomic(offset, value, 0);
  }
  /** And then frames of 8 bits, both ways. */
  exitReads() {
    this.#continuous = false;
    for (const [offset, value] of [
      [0x08, 0],
      [0x00, 0x00070000],
    ])
      this.writeUint32Atomic(offset, value, 0);
    this.#registers.set(0x08, 1);
  }
}

const FUNCTIONS = ['IF', 'EX', 'RE', 'RP', 'FC', 'CX'];

/** Puts a flash chip and a boot ROM into an RP2040. Returns the start of the ROM. */
export function plugFlash(mcu, flash, chip) {
  mcu.flash.set(flash.bytes);
  mcu.flash.fill(0xff, SIZE); // the package's chip is larger
  const ssi = new Ssi(flash, gateFlash(mcu), chip);
  mcu.peripherals[0x18000] = ssi;
  fillRom(mcu);
  const refresh = (at, size) => mcu.flash.set(flash.bytes.subarray(at, at + size), at);
  let exited = false;
  const functions = {
    IF: () => {},
    EX: () => {
      exited = true;
      ssi.exitReads();
    },
    RE: ([at, size]) => {
      if (!exited || at % SECTOR || size % SECTOR)
        return mcu.fault('an erasure of no sectors, or before the exit of XIP');
      for (let sector = at; sector < at + size; sector += SECTOR) {
        flash.erase(sector);
        refresh(sector, SECTOR);
        mcu.clock.tick(ERASE_NS);
      }
    },
    RP: ([at, from, size]) => {
      if (!exited || at % PAGE || size % PAGE)
        return mcu.fault('a program of no pages, or before the exit of XIP');
      for (let page = 0; page < size; page += PAGE) {
        const bytes = Uint8Array.from({length: PAGE}, (_, i) => mcu.sram[from - RAM + page + i]);
        flash.program(at + page, bytes);
        refresh(at + page, PAGE);
        mcu.clock.tick(PROGRAM_NS);
      }
    },
    FC: () => {},
    CX: () => {
      exited = false;
      ssi.readSerially();
    },
  };
  const fault = mcu.onBreak;
  mcu.onBreak = (number) => {
    const at = mcu.core.PC - 2;
    if (at >= ROM_CODE && at < ROM_CODE + 8 * FUNCTIONS.length)
      functions[FUNCTIONS[number]](mcu.core.registers);
    else fault(number);
  };
  return () => {
    // Copies boot 2 behind the RAM's sixth bank; a wrong sum means: wait for a UF2 file over USB.
    ssi.readSerially();
    const boot2 = flash.bytes.subarray(0, BOOT2);
    if (crcOfBoot2(boot2.subarray(0, BOOT2 - 4)) !== view(boot2).getUint32(BOOT2 - 4, true)) return false;
    mcu.sram.set(boot2, BOOT2_AT - RAM);
    mcu.core.VTOR = 0;
    mcu.core.SP = BOOT2_AT;
    mcu.core.LR = 0;
    mcu.core.PC = BOOT2_AT;
    return true;
  };
}

const ROM_TABLE = 0x100;
const ROM_CODE = 0x200;

/** RP2040 data sheet, 2.8.3: the magic, the table of functions, and the function that looks one up. */
function fillRom(mcu) {
  const bytes = new Uint8Array(mcu.bootrom.buffer);
  const words = view(bytes);
  const half = (at, value) => words.setUint16(at, value, true);
  bytes.set([0x4d, 0x75, 1], 0x10);
  half(0x14, ROM_TABLE);
  half(0x18, 0x41);
  // loop: ldrh r2,[r0]; cmp r2,#0; beq none; cmp r2,r1; beq found; adds r0,#4; b loop
  // found: ldrh r0,[r0,#2]; bx lr    none: movs r0,#0; bx lr
  const lookUp = [0x8802, 0x2a00, 0xd005, 0x428a, 0xd001, 0x3004, 0xe7f8, 0x8840, 0x4770, 0x2000, 0x4770];
  lookUp.forEach((opcode, i) => half(0x40 + 2 * i, opcode));
  FUNCTIONS.forEach((name, i) => {
    half(ROM_TABLE + 4 * i, name.charCodeAt(0) | (name.charCodeAt(1) << 8));
    half(ROM_TABLE + 4 * i + 2, (ROM_CODE + 8 * i) | 1);
    half(ROM_CODE + 8 * i, 0xbe00 | i); // bkpt, where this model does the work
    half(ROM_CODE + 8 * i + 2, 0x4770); // bx lr
  });
}
