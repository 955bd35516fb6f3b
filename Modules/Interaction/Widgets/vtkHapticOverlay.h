/**
 * @class   vtkHapticOverlay
 * @brief   words over the picture: status, panel and detail in three corners, the list of keys on request
 *
 * Text on a translucent plate, so that it reads on every cloud. The list of keys takes a smaller font where
 * the renderer is too small for it, down to 7 pixels. pointhaptics::ScreenLayout keeps the rest from lying
 * over each other; without one they stand in their corners. GUI thread only.
 * @sa vtkInteractorStyleHaptic pointhaptics::ScreenLayout
 */
#ifndef vtkHapticOverlay_h
#define vtkHapticOverlay_h

#include "EventLink.h"                     // For the fit before a render
#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkNew.h"                        // For the actors
#include "vtkObject.h"
#include "vtkTextActor.h"   // For the blocks
#include "vtkWeakPointer.h" // For the renderer

#include <string> // For the texts
#include <vector> // For lines

class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticOverlay : public vtkObject
{
public:
  static vtkHapticOverlay* New();
  vtkTypeMacro(vtkHapticOverlay, vtkObject);

  enum Block
  {
    StatusBlock,
    PanelBlock,
    DetailBlock,
    HelpBlock,
    NumberOfBlocks
  };

  /**
   * Text at the upper left, one or more lines; empty hides it. True: it is another text than before.
   */
  bool SetStatus(const std::string& text) { return this->SetText(StatusBlock, text); }

  ///@{
  /**
   * As SetStatus(), at the upper right (a panel of numbers) and at the lower left (details of a picked
   * point).
   */
  bool SetPanel(const std::string& text) { return this->SetText(PanelBlock, text); }
  bool SetDetail(const std::string& text) { return this->SetText(DetailBlock, text); }
  ///@}

  ///@{
  /// The texts as they are shown.
  const std::string& GetStatus() const { return this->Blocks[StatusBlock].text; }
  const std::string& GetPanel() const { return this->Blocks[PanelBlock].text; }
  const std::string& GetDetail() const { return this->Blocks[DetailBlock].text; }
  const std::string& GetHelp() const { return this->Blocks[HelpBlock].text; }
  ///@}

  /**
   * Text of the help plate in the middle. Default: none; vtkInteractorStyleHaptic sets
   * that of its commands. @p key, if there is one, is what its last line says to press for the next page.
   */
  void SetHelp(const std::string& text, const std::string& key = {});

  ///@{
  /**
   * Where the renderer is too small for all lines of the help, in a font that can be read, they are shown by
   * pages: ShowNextHelpPage() goes to the next one; false: there is none. The number is known after a render.
   */
  bool ShowNextHelpPage();
  int GetHelpPage() const { return this->HelpPage; }
  int GetNumberOfHelpPages() const { return this->HelpPages; }
  ///@}

  ///@{
  /**
   * Show the help. Default: off.
   */
  void SetHelpVisibility(bool visible);
  bool GetHelpVisibility() const { return this->Blocks[HelpBlock].actor->GetVisibility() != 0; }
  ///@}

  /**
   * Show status, panel and detail where they have a text; the help does not depend on it. Default: on.
   */
  void SetTextVisibility(bool visible);

  ///@{
  /**
   * Put all texts on opaque plates, whatever lies behind. Default: off, a part of the picture shines through.
   */
  void SetOpaque(bool opaque);
  bool GetOpaque() const { return this->Opaque; }
  ///@}

  ///@{
  /**
   * For a layout. Whether a block is shown; MeasureBlock() breaks its lines where they are wider than @p
   * width pixels with a font of @p font points, leaves out all but the first @p lines, and says how large it
   * is; PlaceBlock() puts its box's corner at (@p left, @p bottom), or hides it until it is placed again.
   */
  bool IsBlockShown(int block) const;
  void MeasureBlock(int block, int font, double width, int lines, double size[2]);
  void PlaceBlock(int block, double left, double bottom);
  void HideBlock(int block) { this->Blocks[block].actor->VisibilityOff(); }
  ///@}

  /**
   * Adds all to @p renderer.
   */
  void AddTo(vtkRenderer* renderer);

protected:
  vtkHapticOverlay();
  ~vtkHapticOverlay() override;

  /// A text and its actor.
  struct TextBlock
  {
    vtkNew<vtkTextActor> actor;
    std::string text;
  };
  TextBlock Blocks[NumberOfBlocks];
  std::string HelpKey;
  int HelpPage = 0;
  int HelpPages = 1;
  bool TextVisibility = true;
  bool Opaque = false;

  void FitHelp();
  int FitHelpFont(const std::string& text, int largest, int smallest, double width, double height);
  void FitHelpPage(const std::vector<std::string>& lines, double width, double height);
  bool SetText(int block, const std::string& text);

  pointhaptics::EventLink Fitting{ [this] { this->FitHelp(); } };
  vtkWeakPointer<vtkRenderer> Renderer;
  int FittedTo[3] = { 0, 0, 0 }; ///< Width, height, dots per inch.

private:
  vtkHapticOverlay(const vtkHapticOverlay&) = delete;
  void operator=(const vtkHapticOverlay&) = delete;
};

#endif
