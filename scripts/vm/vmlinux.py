"""Unpacks the kernel of a vmlinuz, because an emulated machine needs seconds for that. usage: vmlinux.py VMLINUZ OUT"""

import lzma
import sys

XZ = b"\xfd7zXZ\x00"


def main(source, target):
    with open(source, "rb") as file:
        packed = file.read()
    start = packed.find(XZ)
    while start >= 0:
        try:
            kernel = lzma.LZMADecompressor().decompress(packed[start:])
        except lzma.LZMAError:
            kernel = b""
        if kernel.startswith(b"\x7fELF"):
            with open(target, "wb") as file:
                file.write(kernel)
            return 0
        start = packed.find(XZ, start + 1)
    print(f"{source}: no xz-compressed ELF in it", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
