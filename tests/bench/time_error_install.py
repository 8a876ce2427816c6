"""Installs the other programs from the Python package index, each into a virtual environment of its own."""
import os
import subprocess
import sys

# The versions measured, and the Pythons tried: slippy 0.5 runs on 3.7 to 3.10 only.
PEERS = {
    'tamaas': ('tamaas==2.9.0', ['python3']),
    'contactmechanics': ('ContactMechanics==1.8.3', ['python3']),
    'slippy': ('slippy==0.5.0', ['python3', 'python3.10', 'python3.9', 'python3.8']),
}
IMPORTS = {'tamaas': 'tamaas', 'contactmechanics': 'ContactMechanics', 'slippy': 'slippy.core'}
PIP = ['-m', 'pip', 'install', '--disable-pip-version-check', '--no-input', '--timeout', '10',
       '--retries', '1', '--only-binary', 'numpy,scipy,numba,llvmlite,matplotlib,h5py,muGrid,tamaas']
PATIENCE = 600  # [s] for one installation


def succeeds(command, log):
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                              timeout=PATIENCE, check=False).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def python_with(peer, directory):
    """The Python of the environment of a program, which is installed if necessary; None if that fails.

    WAVYCON_PEER_PYTHON may name one more Python to try.
    """
    requirement, interpreters = PEERS[peer]
    home = os.path.join(directory, peer)
    python = os.path.join(home, 'bin', 'python')
    os.makedirs(directory, exist_ok=True)
    with open(home + '.log', 'a', encoding='utf-8') as log:
        probe = [python, '-c', 'import ' + IMPORTS[peer]]
        if succeeds(probe, log):
            return python
        print(f'bench: installing {requirement} into {home} (log beside it)', file=sys.stderr)
        for interpreter in interpreters + [os.environ.get('WAVYCON_PEER_PYTHON', '')]:
            if (interpreter and succeeds([interpreter, '-m', 'venv', '--clear', home], log)
                    and succeeds([python, *PIP, requirement], log) and succeeds(probe, log)):
                return python
    return None
