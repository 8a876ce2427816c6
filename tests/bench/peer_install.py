#!/usr/bin/env python3
"""Installs the other programs from the Python package index, each into a virtual environment of its own.

usage: peer_install.py DIRECTORY [PROGRAM ...]

Prints the name of a Python with numpy and, if they are named, with some of the programs together, which are installed
into DIRECTORY if necessary.
"""
import glob
import os
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / 'support'))
import virtual_environment  # noqa: E402

# The versions measured, and the Pythons tried: slippy 0.5 needs a numpy before 1.21, which 3.7 to 3.9 have.
PEERS = {
    'tamaas': ('tamaas==2.9.0', ['python3']),
    'contactmechanics': ('ContactMechanics==1.8.3', ['python3']),
    'slippy': ('slippy==0.5.0', ['python3', 'python3.9', 'python3.8']),
    'aspher': ('aspher==0.1.3.post1', ['python3']),
}
IMPORTS = {'tamaas': 'tamaas', 'contactmechanics': 'ContactMechanics', 'slippy': 'slippy.core', 'aspher': 'aspher'}
BINARIES = ['--only-binary', 'numpy,scipy,numba,llvmlite,matplotlib,h5py,muGrid,tamaas']


def python_with(peer, directory):
    """The Python of the environment of a program, which is installed if necessary; None if that fails.

    WAVYCON_PEER_PYTHON may name one more Python to try.
    """
    requirement, interpreters = PEERS[peer]
    more = [os.environ['WAVYCON_PEER_PYTHON']] if os.environ.get('WAVYCON_PEER_PYTHON') else []
    if peer == 'aspher':
        offer_eigen(directory)
    return virtual_environment.python_with(os.path.join(directory, peer), [requirement], [IMPORTS[peer]],
                                           interpreters + more, BINARIES)


def offer_eigen(directory):
    """Lets CMake find Eigen, from which aspher is compiled; without it aspher downloads it, which may be barred."""
    home = os.path.abspath(os.path.join(directory, 'eigen'))
    if virtual_environment.python_with(home, ['cmeel-eigen==3.4.1'], ['cmeel']):
        prefixes = glob.glob(os.path.join(home, 'lib', 'python*', 'site-packages', 'cmeel.prefix'))
        os.environ['CMAKE_PREFIX_PATH'] = ':'.join(
            prefixes + [path for path in [os.environ.get('CMAKE_PREFIX_PATH')] if path])


def main():
    programs = sys.argv[2:]
    if len(sys.argv) < 2 or not all(name in PEERS for name in programs):
        sys.exit(__doc__.split('\n\n')[1])
    if 'aspher' in programs:
        offer_eigen(sys.argv[1])
    python = virtual_environment.python_with(
        os.path.join(sys.argv[1], '-'.join(programs) or 'numpy'), ['numpy'] + [PEERS[name][0] for name in programs],
        ['numpy'] + [IMPORTS[name] for name in programs], ['python3'], BINARIES)
    if not python:
        sys.exit(f"peer_install: {' and '.join(programs) or 'numpy'} could not be installed")
    print(python)


if __name__ == '__main__':
    main()
