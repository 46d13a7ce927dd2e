#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/simulation/command_line.h>

namespace Breakwater
{
  CommandLine parse_command_line(const std::vector<std::string> &arguments)
  {
    using Task                             = CommandLine::Task;
    const std::vector<std::string> options = {"--set",    "--output",       "--resume",           "--validate",
                                              "--help",   "--list-plugins", "--print-parameters", "--plugin-path",
                                              "--version"};
    CommandLine                    result;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        // both "--output DIR" and "--output=DIR"
        std::string       option = arguments[i], value;
        const std::size_t equal  = option.find('=');
        const bool        joined = option.rfind("--", 0) == 0 && equal != std::string::npos;
        if (joined)
          {
            value  = option.substr(equal + 1);
            option = option.substr(0, equal);
          }
        if (option == "--set" || option == "--output" || option == "--plugin-path")
          {
            if (!joined && ++i == arguments.size())
              throw InputError("command line: " + option + " needs a value after it");
            if (!joined)
              value = arguments[i];
            if (value.empty())
              throw InputError("command line: the value of " + option + " is empty");
            if (option == "--set")
              result.overrides.push_back(value);
            else if (option == "--output")
              result.output_directory = value;
            else if (std::filesystem::is_directory(value))
              result.plugin_folders.emplace_back(value);
            else
              throw InputError("command line: --plugin-path " + value + " is not a folder");
          }
        else if (joined)
          throw InputError("command line: the option " + option + " with a value is unknown" +
                           suggestion(option, {"--set", "--output", "--plugin-path"}));
        else if (option == "--resume")
          result.resume = true;
        else if (option == "--validate")
          result.task = Task::validate;
        else if (option == "--list-plugins")
          result.task = Task::list_plugins;
        else if (option == "--print-parameters")
          result.task = Task::print_parameters;
        else if (option == "--help" || option == "-h")
          result.task = Task::print_help;
        else if (option == "--version")
          result.task = Task::print_version;
        else if (option.rfind("-", 0) == 0)
          throw InputError("command line: the option " + option + " is unknown" + suggestion(option, options));
        else if (result.parameter_file.empty())
          result.parameter_file = option;
        else
          throw InputError("command line: one parameter file at a time, not " + result.parameter_file.string() +
                           " and " + option);
      }
    if (result.parameter_file.empty() && (result.task == Task::run || result.task == Task::validate))
      throw InputError("command line: a parameter file is missing\n" + command_line_help());
    return result;
  }

  std::string command_line_help()
  {
    return "usage: breakwater FILE.prm [options]\n"
           "  --set \"Section/Entry=value\"  another value for an entry; as often as needed\n"
           "  --output DIR                 where results go, instead of the scene's \"Output/Directory\"\n"
           "  --resume                     go on from the checkpoint in the output folder\n"
           "  --validate                   check everything without running\n"
           "  --print-parameters           all entries of FILE.prm with their documentation; without a file, of all\n"
           "                               plugins\n"
           "  --list-plugins               names, libraries and one line on each plugin\n"
           "  --plugin-path DIR            one more folder of plugin libraries; BREAKWATER_PLUGIN_PATH adds some, too\n"
           "  --version                    versions of the program, deal.II and the compiler\n"
           "Exit status: 0, or 1 for bad input, or 2 for a run that stopped before its end: a numerical breakdown or\n"
           "an interruption.\n";
  }
} // namespace Breakwater
