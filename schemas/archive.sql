-- The tables of an archive. docs/format.md says what every column holds. Comments and blank lines are left
-- out of what an archive stores.

CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;

-- Joints, hierarchy and channels that takes share.
CREATE TABLE skeletons(id INTEGER PRIMARY KEY, structure BLOB NOT NULL, format INTEGER NOT NULL, joints INTEGER NOT NULL, channels INTEGER NOT NULL, root TEXT NOT NULL, digest BLOB NOT NULL);

-- What the files of an actor say besides numbers: offsets and lengths, frame rate, headers.
CREATE TABLE proportions(id INTEGER PRIMARY KEY, skeleton INTEGER NOT NULL REFERENCES skeletons, identity BLOB NOT NULL, unit_mm REAL NOT NULL, up INTEGER NOT NULL, frame_rate REAL NOT NULL, assumed INTEGER NOT NULL, asf_name TEXT NOT NULL, layout BLOB NOT NULL, text BLOB NOT NULL, digest BLOB NOT NULL);

-- Axes, and what else the coder needs before a take can be decoded.
CREATE TABLE spaces(id INTEGER PRIMARY KEY, skeleton INTEGER NOT NULL REFERENCES skeletons, base INTEGER NOT NULL, data BLOB NOT NULL, digest BLOB NOT NULL);

-- Up to 64 takes each: what is known of them and their clips, column by column, and their coded motion. Take t is in block t / 64.
CREATE TABLE blocks(id INTEGER PRIMARY KEY, takes BLOB NOT NULL, digest BLOB NOT NULL, data BLOB NOT NULL);

-- Where takes are found: by their names, and by the IDs of their clips; and blocks of them, by the words, subjects and kinds of clips that they have.
CREATE TABLE keys(id INTEGER PRIMARY KEY, more BLOB NOT NULL);
