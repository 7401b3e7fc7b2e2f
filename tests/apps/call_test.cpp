// What the program says of a wrong call: one line with what is wrong and its cure.

#include "program.hpp"

namespace {

using support::Program;

class Call : public Program {
 protected:
  /// `wrong` is all that the call prints.
  void refuses(const std::string& call, const std::string& wrong, int status = 2) {
    EXPECT_EQ(dda(call), status) << call;
    EXPECT_EQ(err_, wrong + '\n') << call;
    EXPECT_EQ(out_, "") << call;
  }
};

TEST_F(Call, ThatIsWrongIsToldInPlainWords) {
  const std::string kinds = "joints, tunnel, heap, wall, arch, column, voronoi",
                    verbs = "run, check, make, cut, plot, view, safety, sweep, info, help, schema";
  const std::pair<std::string, std::string> rows[] = {
      {"run --setps 3 x.toml", "unknown option \"--setps\" (did you mean \"--steps\"?)"},
      {"run --setps=3 x.toml", "unknown option \"--setps=3\" (did you mean \"--steps\"?)"},
      {"run --nonsense", "unknown option \"--nonsense\" (try dda run --help)"},
      {"--hlep", "unknown option \"--hlep\" (did you mean \"--help\"?)"},
      {"-x", "unknown option \"-x\" (try dda --help)"},
      {"--quiet run x.toml", "unknown option \"--quiet\" (write it after the verb)"},
      {"make wall --colums 3", "unknown option \"--colums\" (try dda make wall --help)"},
      {"make wall --lenght 3", "unknown option \"--lenght\" (did you mean \"--length\"?)"},
      {"make -o a.toml wall", "unknown option \"-o\" (write it after the kind)"},

      {"", "no verb is given (there are: " + verbs + "; try dda --help)"},
      {"rnu x.toml", "unknown verb \"rnu\" (did you mean \"run\"? there are: " + verbs + ")"},
      {"make", "no kind is given (there are: " + kinds + "; try dda make --help)"},
      {"make bricks", "unknown kind \"bricks\" (there are: " + kinds + ")"},
      {"run", "SCENE is missing (try dda run --help)"},
      {"run x.toml y.toml", "\"y.toml\" is one word too many (try dda run --help)"},
      {"make voronoi", "--output FILE is missing (try dda make voronoi --help)"},

      {"run x.toml -o ''", "--output needs a name"},
      {"make joints -o a.toml --face 20", "--face takes a number from 27 to 90, not \"20\""},
      {"run x.toml --steps", "--steps needs a value (write --steps N)"},
      {"run x.toml --steps --quiet", "--steps needs a value (write --steps N)"},
      {"run x.toml -o --quiet", "--output needs a value (write --output DIR)"},
      {"plot d --field -o x.png", "--field needs a value (write --field NAME)"},
      {"run x.toml --steps 5 --steps 6", "--steps takes 1 value, not 2 (write --steps N once)"},
      {"make voronoi -o a.wkt --box 1", "--box takes 2 values, not 1 (write --box WIDTH HEIGHT once)"},
      {"run x.toml --quiet=maybe", "--quiet takes no value (write --quiet)"},
      {"run x.toml --as-stage", "--as-stage needs --resume FILE (try dda run --help)"},
      {"make voronoi -o a.wkt --box 1 1 --domain '0,0 1,0 1,1'",
       "--box and --domain exclude each other (try dda make voronoi --help)"},

      {"run x.toml --steps abc", "--steps takes a whole number, 1 or more, not \"abc\""},
      {"run x.toml --steps 3.5", "--steps takes a whole number, 1 or more, not \"3.5\""},
      {"run x.toml --threads 0", "--threads takes a whole number from 1 to 1024, not \"0\""},
      {"make voronoi -o a.wkt --seed -1", "--seed takes a whole number, 0 or more, not \"-1\""},
      {"cut l.toml -o a.toml --snap -1", "--snap takes a number above 0, not \"-1\""},
      {"cut l.toml -o a.toml --shortest-edge 2", "--shortest-edge takes a number from 0 to 1, not \"2\""},
      {"plot d -o x.svg --magnify nan", "--magnify takes a number from 0 to 1000000000, not \"nan\""},
      {"plot d -o x.svg --vectors speed", "--vectors takes displacement or velocity, not \"speed\""}};
  for (const auto& [call, wrong] : rows) refuses(call, "dda: error: " + wrong);
}

TEST_F(Call, OfAFileThatCannotBeReadOrWrittenEndsWithStatus4) {
  const std::string scene = "'" POLYDDA_EXAMPLES "/paper/sliding_30.toml'";
  for (const char* verb : {"run", "check", "safety -o s", "sweep --vary joint.0.friction_angle=1,2 -o s"})
    refuses(std::string(verb) + " no.toml",
            "no.toml:1:1: error: 'no.toml' cannot be read: No such file or directory (check the path and the "
            "permissions)",
            4);
  refuses("sweep " + scene + " --table no.csv -o s",
          "dda: error: cannot read \"no.csv\": No such file or directory", 4);
  EXPECT_FALSE(support::fs::exists(directory_ / "s"));
  for (const std::string picture : {"nodir/x.svg", "nodir/x.png", "nodir/x.pdf"}) {
    if (dda("plot " + scene + " -o " + picture) == 2) continue;  // built without librsvg
    refuses("plot " + scene + " -o " + picture,
            "dda: error: cannot write \"" + picture + "\": No such file or directory", 4);
  }
}

}  // namespace
