-- The tables of an archive. docs/format.md says what every column holds. Comments and blank lines are left
-- out of what an archive stores.

CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;

-- Joints, hierarchy and channels that takes share.
CREATE TABLE skeletons(id INTEGER PRIMARY KEY, structure BLOB NOT NULL, format INTEGER NOT NULL, joints INTEGER NOT NULL, channels INTEGER NOT NULL, root TEXT NOT NULL, digest BLOB NOT NULL);

-- What the files of an actor say besides numbers: offsets and lengths, frame rate, headers.
CREATE TABLE proportions(id INTEGER PRIMARY KEY, skeleton INTEGER NOT NULL REFERENCES skeletons, identity BLOB NOT NULL, unit_mm REAL NOT NULL, frame_rate REAL NOT NULL, assumed INTEGER NOT NULL, asf_name TEXT NOT NULL, layout BLOB NOT NULL, text BLOB NOT NULL, digest BLOB NOT NULL);

CREATE TABLE subjects(id INTEGER PRIMARY KEY, name TEXT NOT NULL);

-- Axes, and what else the coder needs before a take can be decoded.
CREATE TABLE spaces(id INTEGER PRIMARY KEY, skeleton INTEGER NOT NULL REFERENCES skeletons, base INTEGER NOT NULL, data BLOB NOT NULL, digest BLOB NOT NULL);

CREATE TABLE takes(id INTEGER PRIMARY KEY, leaf TEXT NOT NULL, folder TEXT NOT NULL, subject INTEGER NOT NULL, proportions INTEGER NOT NULL REFERENCES proportions, space INTEGER NOT NULL REFERENCES spaces, frames INTEGER NOT NULL, tier INTEGER NOT NULL, limit_mm REAL NOT NULL, text_bytes INTEGER NOT NULL, mean_um INTEGER NOT NULL, rms_um INTEGER NOT NULL, p99_um INTEGER NOT NULL, max_um INTEGER NOT NULL, sketch BLOB NOT NULL, spent BLOB NOT NULL, source BLOB NOT NULL, layers BLOB NOT NULL, digest BLOB NOT NULL);
CREATE UNIQUE INDEX take_names ON takes(leaf, folder);

CREATE TABLE texts(take INTEGER PRIMARY KEY REFERENCES takes, description TEXT NOT NULL, tags TEXT NOT NULL);

CREATE TABLE clips(address INTEGER NOT NULL, take INTEGER NOT NULL REFERENCES takes, first_frame INTEGER NOT NULL, frames INTEGER NOT NULL, kind INTEGER NOT NULL, family INTEGER NOT NULL, primary_clip INTEGER NOT NULL, bytes INTEGER NOT NULL, PRIMARY KEY(address, take, first_frame)) WITHOUT ROWID;
CREATE INDEX clips_of_take ON clips(take, first_frame);

-- The layers of takes: layer l of take t is row 8 t + l.
CREATE TABLE blobs(id INTEGER PRIMARY KEY, data BLOB NOT NULL);
