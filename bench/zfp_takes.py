"""What zfp makes of the numbers of BVH and AMC files: one stream a take, its channels one after the other, each
within a fixed accuracy, as 4-byte numbers. Needs the command zfp (Debian package zfp)."""
import array
import glob
import json
import multiprocessing
import os
import shutil
import subprocess
import tempfile

ACCURACIES = [0.01, 0.1, 0.5, 1]  # degrees, or the file's unit of length
BLOCK = 4  # numbers that zfp codes together; channels begin at blocks of their own


def is_number(line):
    return line.strip().isdigit()


def split_lines(path):
    """The lines of a take, and of each frame those that hold numbers: its line and where in it they begin."""
    with open(path, encoding="latin-1") as file:
        lines = file.read().splitlines()
    if path.lower().endswith(".bvh"):
        first = next(i for i, line in enumerate(lines) if line.lstrip().lower().startswith("frame time")) + 1
        return lines, [[i] for i in range(first, len(lines)) if lines[i].strip()], 0
    frames = []
    for i, line in enumerate(lines):
        if is_number(line):
            frames.append([])
        elif frames and line.strip():
            frames[-1].append(i)
    return lines, frames, 1


def pad(values):
    return values + values[-1:] * (-len(values) % BLOCK)


def through_zfp(values, accuracy, work):
    """The bytes that zfp needs for 4-byte numbers, and what it gives back."""
    files = {name: os.path.join(work, name) for name in ("raw", "zfp", "back")}
    with open(files["raw"], "wb") as file:
        values.tofile(file)
    subprocess.run(["zfp", "-q", "-f", "-1", str(len(values)), "-a", str(accuracy), "-i", files["raw"],
                    "-z", files["zfp"], "-o", files["back"]], check=True)
    back = array.array("f")
    with open(files["back"], "rb") as file:
        back.fromfile(file, len(values))
    return os.path.getsize(files["zfp"]), back


def with_numbers(lines, frames, skipped, channels):
    """The take's lines with other numbers, `channels` x frames."""
    result = list(lines)
    for f, frame in enumerate(frames):
        values = iter([channel[f] for channel in channels])
        for i in frame:
            words = lines[i].split()
            result[i] = " ".join(words[:skipped] + [f"{next(values):.9g}" for _ in words[skipped:]])
    return result


def compare(reprise, path, decoded):
    command = [reprise, "compare", "--json", path, decoded]
    if path.lower().endswith(".amc"):
        command += ["--asf", glob.glob(os.path.join(glob.escape(os.path.dirname(path)), "*.asf"))[0]]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def measure_take(reprise, path):
    """Of each accuracy: bytes, and the errors that `reprise compare` finds."""
    lines, frames, skipped = split_lines(path)
    numbers = [[float(word) for i in frame for word in lines[i].split()[skipped:]] for frame in frames]
    padded = [pad(list(channel)) for channel in zip(*numbers)]
    flat = array.array("f", [value for channel in padded for value in channel])
    length = len(padded[0])
    results = []
    with tempfile.TemporaryDirectory() as work:
        decoded = os.path.join(work, os.path.basename(path))
        for accuracy in ACCURACIES:
            size, back = through_zfp(flat, accuracy, work)
            channels = [back[c * length:(c + 1) * length] for c in range(len(padded))]
            with open(decoded, "w", encoding="latin-1") as file:
                file.write("\n".join(with_numbers(lines, frames, skipped, channels)) + "\n")
            errors = compare(reprise, path, decoded)
            results.append((size, len(frames) * len(padded), errors["mean_mm"], errors["max_mm"]))
    return results


def measure_takes(reprise, folder, jobs):
    """A row for each accuracy; none where zfp is not installed. In means, takes weigh by how many numbers they have."""
    if shutil.which("zfp") is None:
        return []
    takes = sorted(os.path.join(root, file) for root, _, files in os.walk(folder) for file in files
                   if file.lower().endswith((".bvh", ".amc")))
    with multiprocessing.Pool(jobs) as pool:
        measured = pool.starmap(measure_take, [(reprise, take) for take in takes])
    rows = []
    for i, accuracy in enumerate(ACCURACIES):
        sizes, weights, means, worst = zip(*[take[i] for take in measured])
        rows.append({
            "name": f"zfp -a {accuracy}",
            "payload_bytes": sum(sizes),
            "error_mm": {"mean": sum(mean * weight for mean, weight in zip(means, weights)) / sum(weights),
                         "max": max(worst)},
        })
    return rows
