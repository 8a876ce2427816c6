#!/usr/bin/env python3
"""A model of the time of an iteration of wavycon-mpi, fitted to a table of scaling.py, and its answer for many ranks.

On P points and R ranks, n = P/R points on each, an iteration takes

    n (pairs (a log2 P + b) + c) + e (n + P_whole)      computing
    + 2 n (pairs + double_pairs) t                      exchanges of rows and columns, within the memory of a machine
    + what messages between machines take

a log2 P + b: a pair of transforms. e: the continuation of the gap; each rank does its coarse grids whole, the first
of which has P_whole points. t: an exchange in single precision. c: the rest, the vectors and the steps in double
precision.
On one rank nothing is exchanged, and b and c have other values. All are fitted to grids that are not left out: a and b
to pairs, t to exchanges, e to the continuation, c to iterations on one rank and on two. The check is against measured
iterations on all grids and ranks. Ranks that are more than the processors take turns.

On a cluster, ranks_per_node ranks share the network of their node, of a given bandwidth and latency:

    exchanges       4 bytes a point of single precision, 8 of double, those for other nodes: at the node's bandwidth;
                    R - 1 messages of each rank, one after the other
    sums            up and down a tree: 2 log2 R messages
    neighbours      one message; one on each spread grid of the continuation, two of its adjoint
    whole grids     gathered on all ranks, at the node's bandwidth

usage: scaling_model.py TABLE... [options]; the result goes to standard output, for gnuplot. Its head says what is
measured and what is modelled.
"""
import argparse
import collections
import math
import os
import sys

STRIP = 32              # columns: ranks have whole strips (src/field/grid_slab.f90)
LEAST_SPREAD = 65536    # grids with fewer points are whole on each rank
SUMS = 3                # messages of sums of an iteration
SUMS_TOGETHER = 3       # numbers of a strip in one of them
NEIGHBOURS = 3          # exchanges of columns on a spread grid of the continuation, of an iteration
GATHERS = 3             # of the first whole grid: the contact, the continuation and its adjoint
EXCHANGES = 2           # of rows and columns, of a pair of transforms

Network = collections.namedtuple('Network', 'name bandwidth latency')   # [byte/s], [s]
Iteration = collections.namedtuple('Iteration', 'ranks points seconds pairs double_pairs contact iterations')
Part = collections.namedtuple('Part', 'ranks points name seconds')


def network(words):
    """NAME:GBIT:MICROSECONDS"""
    name, gigabits, microseconds = words.split(':')
    return Network(name, float(gigabits)*1e9/8, float(microseconds)*1e-6)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('tables', nargs='+', help='of scaling.py, with --bench')
    parser.add_argument('--pressure', help='the load; default: the last of the table')
    parser.add_argument('--leave-out', default='', help='points a side of grids to which nothing is fitted')
    parser.add_argument('--processors', type=int, default=os.cpu_count(), help='of the machine measured [%(default)s]')
    parser.add_argument('--network', type=network, action='append', help='NAME:Gbit/s:us, may be repeated; default: '
                        'InfiniBand:100:1.5 and Ethernet:25:20')
    parser.add_argument('--ranks-per-node', type=int, default=32, help='[%(default)s]')
    parser.add_argument('--sides', default='16384,32768,65536', help='points a side [%(default)s]')
    parser.add_argument('--most-ranks', type=int, default=1024, help='[%(default)s]')
    return parser.parse_args()


def blocks(paths):
    """Rows of words of the tables' blocks, by name."""
    found = collections.defaultdict(list)
    for path in paths:
        with open(path, encoding='utf-8') as lines:
            text = lines.read()
        for block in text.split('\n\n\n')[1:]:
            name, _, *rows = block.strip().splitlines()
            found[name[2:]] += [row.split() for row in rows]
    return found


def read(given):
    """Iterations at the load, parts, and the runs' bytes a point by ranks and points."""
    table = blocks(given.tables)
    pressure = given.pressure or table['iterations'][-1][3]
    iterations = [Iteration(int(row[0]), (int(row[1]), int(row[2])), float(row[6])/1e3, float(row[8]), float(row[9]),
                            float(row[4]), int(row[5])) for row in table['iterations'] if row[3] == pressure]
    parts = [Part(int(row[0]), (int(row[1]), int(row[2])), row[3], float(row[4])/1e3) for row in table['parts']]
    runs = [row for row in table['runs'] if row[3] == pressure and int(row[0]) > 0]
    memory = {(int(row[0]), (int(row[1]), int(row[2]))): float(row[13]) for row in runs}
    return pressure, iterations, parts, memory


def of_one(values):
    """x of the least squares of (x k - y)/y, for pairs (k, y): for one coefficient."""
    return sum(k/y for k, y in values)/sum((k/y)**2 for k, y in values)


def of_two(values):
    """x, z of the least squares of (x k + z l - y)/y, for (k, l, y)."""
    kk, kl, ll, k1, l1 = (sum(term) for term in zip(*(((k/y)**2, k*l/y**2, (l/y)**2, k/y, l/y) for k, l, y in values)))
    determinant = kk*ll - kl**2
    return (k1*ll - l1*kl)/determinant, (l1*kk - k1*kl)/determinant


def width_of(columns, ranks):
    """Columns of a rank."""
    return STRIP*math.ceil(columns/STRIP/ranks)


def spread_levels(points, ranks):
    """Grids of the continuation that are spread, and the points of the first that is whole (contact_extension.f90)."""
    width, count, levels = width_of(points[1], ranks), points[0]*points[1], 0
    while True:
        width, count = width/2, count/4
        if width % 2 or count < LEAST_SPREAD:
            return levels, count
        levels += 1


class Model:
    """The fitted coefficients: times for a point [s]."""

    def __init__(self, iterations, parts, processors, left_out):
        self.processors = processors
        fitted = [part for part in parts if not left_out & set(part.points)]
        whole = [(part.points[0]*part.points[1], part.seconds) for part in fitted
                 if part.ranks == 1 and part.name == 'pair']
        self.a, self.b = of_two([(count*math.log2(count), count, seconds) for count, seconds in whole])
        self.e = of_one([(part.points[0]*part.points[1], part.seconds) for part in fitted
                         if part.ranks == 1 and part.name == 'extension'])
        spread = [(part.name, part.points[0]*part.points[1]/2, part.seconds) for part in fitted if part.ranks == 2]
        self.t = of_one([(n, seconds) for name, n, seconds in spread if name == 'rows'])
        # The pairs of two ranks differ from those of one by more than the exchanges.
        excess = [(n, seconds - n*(self.a*math.log2(2*n) + EXCHANGES*self.t)) for name, n, seconds in spread
                  if name == 'pair']
        self.b_spread = sum(rest for _, rest in excess)/sum(n for n, _ in excess)
        self.latency = {}
        for ranks in {part.ranks for part in parts if part.ranks > 1}:
            self.latency[ranks] = [sorted(part.seconds for part in parts if (part.ranks, part.name) == (ranks, name))
                                   for name in ('sums', 'halo')]
            self.latency[ranks] = [times[len(times)//2] for times in self.latency[ranks]]
        self.c = self.c_spread = 0.0
        self.c = self.rest([one for one in iterations if one.ranks == 1 and not left_out & set(one.points)])
        self.c_spread = self.rest([one for one in iterations if one.ranks == 2 and not left_out & set(one.points)])

    def rest(self, chosen):
        """The rest of an iteration, for a point: mean over the grids weighted by points."""
        points = sum(one.points[0]*one.points[1]/one.ranks for one in chosen)
        return sum(one.seconds - self.here(one) for one in chosen)/points

    def computing(self, points, ranks, pairs):
        """Transforms and the rest."""
        count = points[0]*points[1]
        n = count/ranks
        spread = ranks > 1
        transforms = n*pairs*(self.a*math.log2(count) + (self.b_spread if spread else self.b))
        rest = n*(self.c_spread if spread else self.c)
        return transforms, rest + self.e*(n + (spread_levels(points, ranks)[1] if spread else 0.0))

    def exchanging(self, count, ranks, one):
        """Exchanges of rows and columns in the memory of a machine."""
        return EXCHANGES*self.t*(one.pairs + one.double_pairs)*count/ranks if ranks > 1 else 0.0

    def here(self, one):
        """The time of an iteration on the machine measured."""
        time = sum(self.computing(one.points, one.ranks, one.pairs))
        time += self.exchanging(one.points[0]*one.points[1], one.ranks, one)
        time *= one.ranks/min(one.ranks, self.processors)
        if one.ranks > 1:
            sums, halo = self.latency[one.ranks]
            time += SUMS*sums + NEIGHBOURS*spread_levels(one.points, one.ranks)[0]*halo
        return time

    def cluster(self, side, ranks, one, net, ranks_per_node):
        """Ranks with columns, and the times on a cluster: transforms, rest, exchanges and other messages."""
        points, count = (side, side), side*side
        used = math.ceil(side/width_of(side, ranks))
        transforms, rest = self.computing(points, used, one.pairs)
        if used == 1:
            return used, transforms, rest, 0.0, 0.0
        nodes = math.ceil(used/ranks_per_node)
        on_node = min(used, ranks_per_node)
        bytes_of_rank = 4*(one.pairs + one.double_pairs)*count/used
        exchanges = self.exchanging(count, used, one)
        if nodes > 1:
            exchanges += EXCHANGES*(on_node*bytes_of_rank*(1 - on_node/used)/net.bandwidth
                                    + one.pairs*(used - 1)*net.latency)
        latency = net.latency if nodes > 1 else self.latency[2][1]
        depth = 2*math.ceil(math.log2(used))
        sum_bytes = 8*SUMS_TOGETHER*math.ceil(side/STRIP)
        levels, whole = spread_levels(points, used)
        messages = SUMS*depth*(latency + sum_bytes/net.bandwidth)
        messages += NEIGHBOURS*levels*(latency + 4*side/net.bandwidth)
        messages += GATHERS*(depth*latency + (4*whole/net.bandwidth if nodes > 1 else 0.0))
        return used, transforms, rest, exchanges, messages


def check_lines(model, iterations, left_out):
    lines = ['', '', '# check', '#    ranks   points_x   points_y  measured[ms]  modelled[ms]   error[%]   fitted']
    for one in sorted(iterations):
        modelled = model.here(one)
        fitted = one.ranks <= 2 and not left_out & set(one.points)
        lines.append(f'{one.ranks:10d}{one.points[0]:11d}{one.points[1]:11d}{1e3*one.seconds:14.3f}{1e3*modelled:14.3f}'
                     f'{100*(modelled/one.seconds - 1):11.1f}   {"yes" if fitted else "no"}')
    return lines


def table_lines(model, given, one, net, bytes_a_point):
    lines = ['', '', f'# {net.name}',
             '# modelled: seconds of an iteration and of its parts; speed-up over one rank, if it had the memory',
             '#    side   ranks    used  iteration[s]  transforms[s]    rest[s]  exchanges[s]  messages[s]'
             '   speed_up  efficiency  memory[GB]']
    for side in (int(word) for word in given.sides.split(',')):
        ranks, alone = 1, None
        while ranks <= given.most_ranks:
            used, *times = model.cluster(side, ranks, one, net, given.ranks_per_node)
            alone = alone or sum(times)
            memory = bytes_a_point*side*side/used/1e9
            lines.append(f'{side:9d}{ranks:8d}{used:8d}{sum(times):14.4f}{times[0]:15.4f}{times[1]:11.4f}'
                         f'{times[2]:14.4f}{times[3]:13.5f}{alone/sum(times):11.1f}{alone/sum(times)/ranks:12.2f}'
                         f'{memory:12.3f}')
            ranks *= 2
        lines.append('')
    return lines


def main():
    given = arguments()
    networks = given.network or [network('InfiniBand:100:1.5'), network('Ethernet:25:20')]
    pressure, iterations, parts, memory = read(given)
    left_out = {int(word) for word in given.leave_out.split(',') if word}
    model = Model(iterations, parts, given.processors, left_out)
    largest = max((one for one in iterations if one.ranks <= 2),
                  key=lambda one: (one.points[0]*one.points[1], one.ranks))
    bytes_a_point = memory[largest.ranks, largest.points]
    nano = 1e9
    print('\n'.join([
        f'# Time of an iteration of wavycon-mpi: {os.path.basename(__file__)} says how it is modelled.',
        f'# MEASURED are the times and bytes of {", ".join(os.path.basename(path) for path in given.tables)}',
        '# and the errors of the block check; all other numbers are MODELLED.',
        f'# Mean pressure {pressure} E* rms slope, {100*largest.contact:.0f} % of the points in contact.',
        f'# An iteration has {largest.pairs:.2f} pairs of transforms, {largest.double_pairs:.2f} of them in double '
        'precision.',
        f'# {largest.iterations} iterations on the last grid, to a residual of 1e-8.',
        f'# Fitted [ns a point]: a {nano*model.a:.4f}, t {nano*model.t:.3f}, e {nano*model.e:.3f}; on one rank '
        f'b {nano*model.b:.3f} and c {nano*model.c:.3f},',
        f'# on several b {nano*model.b_spread:.3f} and c {nano*model.c_spread:.3f}.',
        f'# Memory: {bytes_a_point:.1f} bytes a point, measured on {largest.points[0]} x {largest.points[1]} points, '
        f'{largest.ranks} ranks.',
        f'# ASSUMED of the cluster: {given.ranks_per_node} ranks on a node, each as fast as one of '
        f'{min(2, given.processors)} here; networks of which each node has',
        *[f'#    {net.name}: {net.bandwidth*8/1e9:g} Gbit/s, {net.latency*1e6:g} us a message' for net in networks],
        *check_lines(model, iterations, left_out),
        *[line for net in networks for line in table_lines(model, given, largest, net, bytes_a_point)]]))


if __name__ == '__main__':
    sys.exit(main())
