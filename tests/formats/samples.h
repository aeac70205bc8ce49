// Small files with everything that parsers stumble over.
#pragma once

#include <string>
#include <vector>

namespace reprise {

struct Sample {
  std::string name;
  std::string motion;    ///< BVH, or AMC where there is a skeleton
  std::string skeleton;  ///< ASF
};

inline std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

inline std::string plain_bvh() {
  return "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0.0 .5 -0\n\tCHANNELS 6 Xposition Yposition Zposition "
         "Zrotation "
         "Xrotation Yrotation\n\tJOINT Left Up Leg\n\t{\n\t\tOFFSET 1e+01 4.56e-2 +3\n\t\tCHANNELS "
         "3 Zrotation "
         "Yrotation Xrotation\n\t\tEnd Site and more\n\t\t{\n\t\t\tOFFSET 0 -40 "
         "0\n\t\t}\n\t}\n\tJOINT empty\n\t{\n"
         "\t\tOFFSET 0 0 0\n\t\tCHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation "
         "Zrotation\n\t}\n}\n"
         "MOTION\nFrames: 3\nFrame Time: 0.0083333\n"
         ".34 4.56e-2 1e+05 -0 +1 -179.5 1 2 3 0 0 0 4 5 6 \n"
         "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n"
         "\t-1.5\t2 3 4 5 6 7 8 9 10 11 12 13 14 720.25\n";
}

inline std::string plain_asf() {
  return "# comment\n:version 1.10\n:name test\n:units\n  mass 1\n  length 0.45\n  angle "
         "deg\n:documentation\n   any "
         "text\n:root\n   order TX TY TZ RZ RY RX\n   axis ZYX\n   position 1 2 3\n   orientation "
         "0 0 0\n:bonedata\n  "
         "begin\n     id 1\n     name femur\n     direction 0.34 -0.94 0\n     length 7.5\n     "
         "axis 0 0 20 XYZ\n    "
         "dof ry rx rz\n    limits (-160.0 20.0)\n           (-70.0 70.0)\n           (-60.0 "
         "70.0)\n  end\n  begin\n "
         "    id 2\n     name tibia\n     direction 0 -1 7.62852e-016\n     length 6\n     axis "
         "-90 10 20 ZYX\n    dof "
         "tx rz l\n  end\n  begin\n     id 3\n     name toes\n     direction 0 0 1\n     length "
         "2\n     axis 0 0 0 "
         "XYZ\n  end\n  begin\n     id 4\n     name hand\n     direction 1 0 0\n     length 2\n    "
         " axis 0 0 0 XYZ\n    "
         "dof rx\n  end\n:hierarchy\n  begin\n    root femur hand\n    femur tibia\n    tibia "
         "toes\n  end\n";
}

inline std::string plain_amc() {
  return "#!OML:ASF somewhere\n:FULLY-SPECIFIED\n:DEGREES\n7\nroot 1 2 3 4 5 6\ntibia .5 "
         "-1.6201e-014 2\nfemur 1 2 3\n"
         "8\nroot 1.5 2 3 4 5 6.25\ntibia .5 1 2\nfemur -1 +2 3 # comment\n";
}

/// As a Windows editor may leave it: a byte order mark, empty lines, several statements on a line,
/// words in any case, six channels on every joint, a name twice.
inline std::string odd_bvh() {
  return "\xEF\xBB\xBF\n\nhierarchy\r\nRoot  a b\t{ OFFSET .0 5. -.25 channels 6 XPosition "
         "YPosition "
         "ZPosition ZROTATION XRotation yrotation\r\n  joint twin { offset 0 0 0 Channels 6 "
         "Xposition "
         "Yposition Zposition Zrotation Xrotation Yrotation End Site { OFFSET 1E1 0 0 } }\r\n\r\n"
         "\tJOINT twin\r\n{\r\nCHANNELS 6 Zrotation Yrotation Xrotation Zposition Yposition "
         "Xposition\r\nOFFSET 0 0 0\r\n}\r\n}\r\n\r\nmotion\r\nFRAMES:2\r\nframe "
         "time : 1.6667e-2\r\n\r\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18\r\n\r\n"
         "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18.5\t \r\n\r\n";
}

/// Sections in another order, angles in radians, no length unit, words in any case.
inline std::string odd_asf() {
  return ":HIERARCHY_NOTE\nany\n:Root\naxis xyz\norder rz TY RX tz ry TX\n:bonedata\nBEGIN\nname "
         "a\n"
         "DOF RZ RX\naxis 0.5 0 -.25 YZX\nlength 1e+1\ndirection 0 0 1\nlimits (-inf inf)\n(-1 1)\n"
         "bodymass 3\nEND\nbegin\nname b\ndirection 0 1 0\nend\n:units\nangle rad\n"
         ":hierarchy\nbegin\nroot a # comment\na b\nend\n";
}

inline std::string odd_amc() {
  return "# no keyword at all\n0\na 1 2\n\n1\na 3 4 # comment\n\n# comment\n2\na -5 1e-3\n";
}

inline std::vector<Sample> samples() {
  std::string radians = plain_amc();
  radians.replace(radians.find(":DEGREES"), 8, ":RADIANS");
  return {
      {"bvh", plain_bvh(), ""},
      {"bvh with CRLF", with_line_ends(plain_bvh(), "\r\n"), ""},
      {"bvh with CR", with_line_ends(plain_bvh(), "\r"), ""},
      {"bvh without last line end", plain_bvh().substr(0, plain_bvh().size() - 1), ""},
      {"amc that leaves out a bone", plain_amc(), plain_asf()},
      {"amc with CRLF", with_line_ends(plain_amc(), "\r\n"), with_line_ends(plain_asf(), "\r\n")},
      {"amc in radians", radians, plain_asf()},
      {"odd bvh", odd_bvh(), ""},
      {"odd amc", odd_amc(), odd_asf()}};
}

}  // namespace reprise
