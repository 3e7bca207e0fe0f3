#!/usr/bin/env python3
"""A study on a real Slurm cluster of two nodes, one of which is killed half-way.

Starts munged, slurmctld and two slurmd of its own on this machine (as root; the packages are
slurm-wlm and munge), submits a study with `fenestra submit --slurm`, kills one node with all that
runs on it, and compares the merged rows with those of a single run. Exit code 77: skipped.
"""

import argparse
import os
import pathlib
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time

STUDY = """
name: two-nodes
repetitions: {repetitions}
sensors: [stereo]
detectors: [paper-stereo]
factors:
  distance_m: [5, 6]
  stereo_width_px: 320
  stereo_height_px: 240
  yaw_deg: {{uniform: [-2, 2]}}
"""

CONFIGURATION = """
ClusterName=fenestra
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=1
SlurmdTimeout=60
KillWait=2
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={port1} CPUs=1
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={port2} CPUs=1
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""

SHARDS = 4


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def wait_for(what, condition, seconds):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"FAILED: no {what} within {seconds} s")
        time.sleep(0.2)


class Cluster:
    """munged, slurmctld, n1 and n2; everything that was started ends with it."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = {}
        os.mkdir(folder / "state")
        os.mkdir(folder / "munge", 0o755)
        ports = free_ports(3)
        configuration = folder / "slurm.conf"
        configuration.write_text(
            CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=folder,
                                 controller_port=ports[0], port1=ports[1], port2=ports[2]))
        self.environment = dict(os.environ, SLURM_CONF=str(configuration))

    def start(self, name, command):
        log = open(self.folder / f"{name}.log", "wb")
        self.processes[name] = subprocess.Popen(command, stdout=log, stderr=log,
                                                stdin=subprocess.DEVNULL, env=self.environment)

    def start_all(self):
        munge = self.folder / "munge"
        key = munge / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.start("munged", ["munged", "--foreground", "--force", f"--key-file={key}",
                              f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                              f"--log-file={munge}/log", f"--seed-file={munge}/seed"])
        wait_for("munged", (munge / "socket").exists, 20)
        self.start("slurmctld", ["slurmctld", "-D", "-i"])
        for node in ("n1", "n2"):
            os.mkdir(self.folder / f"spool-{node}")
            self.start(node, ["slurmd", "-D", "-N", node])
        wait_for("two idle nodes", lambda: self.run("sinfo", "-h", "-o", "%D %t") == "2 idle", 60)

    def run(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return done.stdout.strip() if done.returncode == 0 else ""

    def processes_of(self, node):
        """Of the jobs on a node: their environment names it, and this cluster's configuration."""
        found = []
        wanted = {f"SLURMD_NODENAME={node}", f"SLURM_CONF={self.environment['SLURM_CONF']}"}
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                variables = set((entry / "environ").read_bytes().decode(errors="replace").split("\0"))
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                name = pathlib.Path(f"/proc/{parent}/comm").read_text().strip()
            except OSError:
                continue
            if wanted <= variables:
                found.append(int(entry.name))
                if name == "slurmstepd":
                    found.append(parent)
        return found

    def kill_node(self, node):
        """As if its power went: nothing on it comes to an end by itself."""
        self.processes[node].kill()
        for process in self.processes_of(node):
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        # What the controller finds out after SlurmdTimeout.
        self.run("scontrol", "update", f"nodename={node}", "state=down", "reason=killed")

    def stop(self):
        self.run("scancel", "--user=root")
        time.sleep(1)
        for node in ("n1", "n2"):
            for process in self.processes_of(node):
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        for process in self.processes.values():
            process.kill()
            process.wait()


def query(results, sql):
    with sqlite3.connect(f"file:{results}/results.sqlite?mode=ro", uri=True, timeout=60) as store:
        return store.execute(sql).fetchall()


def count(results):
    return query(results, "SELECT count(*) FROM trials")[0][0] if results.exists() else 0


def rows(results):
    names = [row[1] for row in query(results, "PRAGMA table_info(trials)")]
    columns = ", ".join(name for name in names if name != "stage_times_s")
    return query(results, f"SELECT {columns} FROM trials ORDER BY cell, trial, detector")


def check(cluster, program, repetitions):
    folder = cluster.folder
    study = folder / "study.yaml"
    study.write_text(STUDY.format(repetitions=repetitions))
    out = folder / "out"
    print(subprocess.run([program, "submit", study, "--slurm", "--shards", str(SHARDS), "--out", out],
                         env=cluster.environment, check=True, capture_output=True,
                         text=True).stdout, end="")

    def running_on(node):
        listed = cluster.run("squeue", "-h", "-r", "-t", "running", "-w", node, "-o", "%K")
        return listed.split()[0] if listed else ""

    wait_for("task on n2", lambda: running_on("n2"), 60)
    task = running_on("n2")
    shard = out / "shards" / task
    whole = 2 * repetitions // SHARDS

    def half_way():
        return (shard / "results.sqlite").exists() and count(shard) >= whole // 3

    wait_for("rows on n2", half_way, 120)
    cluster.kill_node("n2")
    kept = count(shard)
    print(f"n2 was killed with {kept} of the {whole} trials of shard {task}/{SHARDS} stored")
    assert kept < whole, "the node was killed too late"
    wait_for("end of the merge", lambda: (out / "summary.md").exists(), 300)
    wait_for("end of all jobs", lambda: cluster.run("squeue", "-h") == "", 60)

    runs = query(shard, "SELECT ended_utc FROM runs ORDER BY run")
    assert len(runs) == 2 and runs[0][0] is None and runs[1][0], f"runs of the shard: {runs}"
    subprocess.run([program, "run", study, "--out", folder / "single", "--jobs", "1"], check=True,
                   capture_output=True)
    merged = rows(out)
    assert len(merged) == 2 * repetitions
    assert merged == rows(folder / "single"), "merged rows are not those of a single run"
    print(f"{len(merged)} merged rows are those of a single run")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--fenestra", required=True)
    arguments.add_argument("--repetitions", type=int, default=120)
    arguments.add_argument("--keep", action="store_true", help="keeps the folder with all logs")
    options = arguments.parse_args()
    for program in ("munged", "slurmctld", "slurmd", "sbatch"):
        if shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None:
            skip(f"{program} is not installed (apt-get install slurm-wlm munge)")
    if os.geteuid() != 0:
        skip("slurmd needs root")
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    folder = pathlib.Path(tempfile.mkdtemp(prefix="fenestra-slurm-"))
    folder.chmod(0o755)
    cluster = Cluster(folder)
    try:
        cluster.start_all()
        check(cluster, options.fenestra, options.repetitions)
    finally:
        cluster.stop()
        if options.keep:
            print(f"logs are in {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
