"""`python -m wavycon DECK` runs the program, with its options."""
import os
import sys

from .programs import program

path = program()
os.execv(path, [path, *sys.argv[1:]])
