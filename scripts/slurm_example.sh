#!/usr/bin/env bash
# Runs a large rough surface on several machines under Slurm: `sbatch scripts/slurm_example.sh`, after
# `scripts/build --mpi` there. Take it as the start of your own.
#
# Deck: inputs/challenge.nml, the kind of surface of the contact-mechanics challenge, on 32768 x 32768 points.
#
# Memory: two ranks together took 63 to 66 bytes a point from 4096 x 4096 points on (tests/evidence.md, "Past one
# machine"). For 1.07e9 points 66 are 71 GB, 4.4 GB for each of 16 ranks of 8 processors, and 0.4 GB are left for MPI.
# Ranks: they have whole strips of 32 columns, so at most points/32 of them have any, here 1024. Few ranks with some
# threads each send fewer and larger messages than a rank for each processor.
# Time: there 8192 x 8192 points took 94 s on two ranks, for 230 iterations on all grids. A load takes as many here, or
# somewhat more, on 16 times as many points.
#SBATCH --job-name=wavycon
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=4
#SBATCH --cpus-per-task=8
#SBATCH --mem-per-cpu=600M
#SBATCH --time=04:00:00
set -euo pipefail

# Slurm runs a copy of this file: the tree is where sbatch was called.
cd "${SLURM_SUBMIT_DIR:-.}"
threads=${SLURM_CPUS_PER_TASK:-1}
export OPENBLAS_NUM_THREADS=1 OMP_WAIT_POLICY=passive

# If Slurm does not know the MPI library: mpirun --map-by "slot:PE=$threads" in place of srun.
# --resume continues a job that was ended by its time limit, on any number of ranks; the first time it does nothing.
srun --cpus-per-task="$threads" --cpu-bind=cores build/wavycon-mpi inputs/challenge.nml --threads "$threads" --resume \
   --set surface.points=32768 --output outputs/challenge_32768
