"""Servers whose memory, disk, descriptors and clock fail when a test says so (faults.c). Not under a sanitizer, which has its own malloc."""
import mmap
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import daemon

LIBRARY = []
FIELDS = ('fail_at', 'allocations', 'live', 'failed', 'by_library', 'full', 'descriptors', 'shift_s', 'slow', 'waiting')


class Faults:
    def __init__(self):
        self.file = tempfile.NamedTemporaryFile()
        self.file.write(struct.pack('<10q', -1, *[0] * 9))
        self.file.flush()
        self.map = mmap.mmap(self.file.fileno(), 80)

    def __getattr__(self, name):
        return struct.unpack_from('<q', self.map, 8 * FIELDS.index(name))[0]

    def set(self, name, value):
        struct.pack_into('<q', self.map, 8 * FIELDS.index(name), value)

    def start(self, *options):
        os.environ.update(KD_FAULTS=self.file.name, LD_PRELOAD=LIBRARY[0])
        try:
            return daemon.Daemon('--drain-ms', 10, *options)
        finally:
            del os.environ['KD_FAULTS'], os.environ['LD_PRELOAD']

    def close(self):
        self.map.close()
        self.file.close()


def sanitized():
    with open(daemon.COMMAND[0], 'rb') as f:
        return b'__asan_init' in f.read()



def main():
    LIBRARY.append(os.path.abspath(sys.argv.pop(1)))
    daemon.main()
