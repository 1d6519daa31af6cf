"""The record of all runs: one SQLite file, a row a run."""

import json
import sqlite3
import zlib

COLUMNS = {
    "family": "TEXT NOT NULL", "seed": "INTEGER NOT NULL", "commit_id": "TEXT NOT NULL",
    "limits": "TEXT NOT NULL", "parameters": "TEXT NOT NULL", "model_hash": "TEXT NOT NULL",
    "vertices": "INTEGER", "faces": "INTEGER", "sites": "INTEGER", "outcome": "TEXT NOT NULL",
    "reason": "TEXT NOT NULL", "certified": "INTEGER", "betti_expected": "TEXT",
    "betti_solid": "TEXT", "betti": "TEXT", "leaves": "INTEGER", "max_depth": "INTEGER",
    "undecided_cells": "INTEGER", "undecided_depth": "INTEGER", "stage_filter": "INTEGER", "stage_extended": "INTEGER",
    "stage_exact": "INTEGER", "time_s": "REAL", "cpu_s": "REAL", "memory": "INTEGER",
    "exit_code": "INTEGER", "signal": "INTEGER", "late": "INTEGER", "axis_checked": "INTEGER",
    "certificate": "TEXT", "statement": "TEXT", "certificate_s": "REAL", "verify_s": "REAL",
    "certificate_cpu_s": "REAL", "verify_cpu_s": "REAL", "certificate_memory": "INTEGER",
    "verify_memory": "INTEGER",
    "certificate_bytes": "INTEGER", "stderr": "TEXT", "model": "BLOB",
}


class Store:
    def __init__(self, path):
        self.base = sqlite3.connect(path, timeout=60)
        self.base.row_factory = sqlite3.Row
        columns = ", ".join(f"{name} {kind}" for name, kind in COLUMNS.items())
        with self.base:
            self.base.execute(f"CREATE TABLE IF NOT EXISTS run (id INTEGER PRIMARY KEY, {columns}, "
                              "UNIQUE (family, seed, commit_id, limits))")
            # A file of an older version; what is new is unknown of its runs.
            there = {row["name"] for row in self.base.execute("PRAGMA table_info(run)")}
            for name, kind in COLUMNS.items():
                if name not in there:
                    self.base.execute(f"ALTER TABLE run ADD COLUMN {name} {kind}")

    def close(self):
        self.base.close()

    def add(self, row, mesh=None):
        """Gives the run's id. `mesh` is kept if given: the generators may change."""
        row = dict(row)
        for name, value in row.items():
            if isinstance(value, (list, dict)):
                row[name] = json.dumps(value)
        if mesh is not None:
            row["model"] = zlib.compress(mesh.off().encode(), 9)
        unknown = set(row) - set(COLUMNS)
        if unknown:
            raise KeyError(unknown)
        with self.base:
            cursor = self.base.execute(
                f"INSERT INTO run ({', '.join(row)}) VALUES ({', '.join('?' * len(row))})",
                list(row.values()))
        return cursor.lastrowid

    def done(self, commit, limits):
        rows = self.base.execute("SELECT family, seed FROM run WHERE commit_id = ? AND limits = ?",
                                 (commit, limits))
        return {tuple(row) for row in rows}

    def run(self, identifier):
        return self.base.execute("SELECT * FROM run WHERE id = ?", (identifier,)).fetchone()

    def runs(self, condition="1", values=()):
        return self.base.execute(f"SELECT * FROM run WHERE {condition} ORDER BY id",
                                 values).fetchall()


def model_text(row):
    return zlib.decompress(row["model"]).decode() if row["model"] is not None else None
