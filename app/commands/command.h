// The commands of `molar`. Each function adds options and action to the command line; the action returns the exit
// status: 0 success, 1 the answer is "no". Bad input throws; main prints one line and exits with 2.
#pragma once

#include <initializer_list>

namespace app {

class CommandLine;

void addRehearse(CommandLine& molar);
void addStart(CommandLine& molar);
void addImport(CommandLine& molar);
void addInspect(CommandLine& molar);
void addCheck(CommandLine& molar);
void addPlan(CommandLine& molar);
void addFeel(CommandLine& molar);
void addCarve(CommandLine& molar);
void addClearance(CommandLine& molar);
void addSee(CommandLine& molar);
void addRadiograph(CommandLine& molar);
void addDisplay(CommandLine& molar);
void addCalibrate(CommandLine& molar);
void addDevices(CommandLine& molar);
void addDoctor(CommandLine& molar);
void addReplay(CommandLine& molar);
void addMetrics(CommandLine& molar);
void addDebrief(CommandLine& molar);
void addReport(CommandLine& molar);
void addCompare(CommandLine& molar);
void addTrend(CommandLine& molar);
void addReference(CommandLine& molar);
void addEvaluate(CommandLine& molar);
void addSeat(CommandLine& molar);
void addPage(CommandLine& molar);
void addVoice(CommandLine& molar);
void addStudy(CommandLine& molar);
void addSessions(CommandLine& molar);
void addExport(CommandLine& molar);
void addTeeth(CommandLine& molar);
void addPieces(CommandLine& molar);
void addFile(CommandLine& molar);
void addLaws(CommandLine& molar);
void addPsychophysics(CommandLine& molar);
void addHelp(CommandLine& molar);
void addManual(CommandLine& molar);
void addCompletion(CommandLine& molar);

/// In the order of --help.
inline constexpr auto kCommands = {
    addRehearse, addStart,         addImport,     addInspect, addCheck,     addPlan,      addClearance, addFeel,
    addCarve,    addSee,           addRadiograph, addDisplay, addCalibrate, addDevices,   addDoctor,    addDebrief,
    addReplay,   addMetrics,       addReport,     addCompare, addTrend,     addReference, addEvaluate,  addStudy,
    addSessions, addExport,        addPieces,     addTeeth,   addFile,      addLaws,      addSeat,      addPage,
    addVoice,    addPsychophysics, addHelp,       addManual,  addCompletion};

}  // namespace app
