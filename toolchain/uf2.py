"""Writes an image of an RP2040 as a UF2 file, with the sum of its second-stage bootloader and its own.

usage: uf2.py IMAGE.elf OUT.uf2
"""

import struct
import sys
import zlib

FLASH, FLASH_END = 0x10000000, 0x10200000
FAMILY = 0xE48BFF56  # RP2040
PAGE = 256
BOOT2 = 252
HEADER = FLASH + 0x100 + 4 * 48  # behind the vectors: hal/boards/pico/image.hpp
MAGIC = 0x4B534857


def flash_of(elf):
    """The bytes that the image's segments have in the flash, from its start."""
    if elf[:6] != b"\x7fELF\x01\x01":
        sys.exit("uf2: not a 32-bit ELF file")
    start, = struct.unpack_from("<I", elf, 28)
    size, count = struct.unpack_from("<HH", elf, 42)
    flash = bytearray()
    for i in range(count):
        kind, offset, _, address, length = struct.unpack_from("<5I", elf, start + i * size)
        if kind != 1 or length == 0 or not FLASH <= address < FLASH_END:
            continue
        end = address - FLASH + length
        flash.extend(b"\xff" * (end - len(flash)))
        flash[address - FLASH:end] = elf[offset:offset + length]
    return flash


def sum_of_boot2(data):
    """RP2040 data sheet, 2.8.1.3.1."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = crc << 1 ^ (0x04C11DB7 if crc & 0x80000000 else 0)
        crc &= 0xFFFFFFFF
    return crc


def seal(flash):
    struct.pack_into("<I", flash, BOOT2, sum_of_boot2(flash[:BOOT2]))
    at = HEADER - FLASH
    magic, end, blank = struct.unpack_from("<III", flash, at)
    if magic != MAGIC or end != FLASH + len(flash) or blank != 0xFFFFFFFF:
        sys.exit("uf2: the image has no header, or another size than that says")
    struct.pack_into("<I", flash, at + 8, zlib.crc32(flash))


def blocks(flash):
    flash = flash + b"\xff" * (-len(flash) % PAGE)
    count = len(flash) // PAGE
    for i in range(count):
        head = struct.pack("<8I", 0x0A324655, 0x9E5D5157, 0x2000, FLASH + PAGE * i, PAGE, i, count, FAMILY)
        data = flash[PAGE * i:PAGE * (i + 1)]
        yield head + data + b"\0" * (476 - PAGE) + struct.pack("<I", 0x0AB16F30)


def main(image, out):
    with open(image, "rb") as file:
        flash = flash_of(file.read())
    seal(flash)
    with open(out, "wb") as file:
        file.write(b"".join(blocks(bytes(flash))))
    print(f"{out}: {len(flash):,} bytes of flash")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    main(*sys.argv[1:])
